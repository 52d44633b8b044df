# SPDX-License-Identifier: Apache-2.0
"""Tests of the verbs of `ros2 interface`."""

from collections.abc import Callable
import io
import os
from pathlib import Path
from subprocess import CompletedProcess

import pytest
from ros2interface.definition import field_type

Ros2 = Callable[..., CompletedProcess[str]]


def test_list_has_headings(ros2_here: Ros2) -> None:
    """All kinds are listed under their headings, sorted and indented by four spaces."""
    lines = ros2_here('interface', 'list').stdout.splitlines()
    headings = [line for line in lines if not line.startswith('    ')]
    assert headings == ['Messages:', 'Services:', 'Actions:']
    services = lines.index('Services:')
    messages = lines[1:services]
    assert '    std_msgs/msg/Header' in messages
    assert messages == sorted(messages)


@pytest.mark.parametrize(
    ('option', 'heading'), [('-m', 'Messages:'), ('-s', 'Services:'), ('-a', 'Actions:')]
)
def test_list_of_one_kind(option: str, heading: str, ros2_here: Ros2) -> None:
    """An option leaves one heading with its interfaces."""
    lines = ros2_here('interface', 'list', option).stdout.splitlines()
    assert [line for line in lines if not line.startswith(' ')] == [heading]


def test_packages_are_chosen_by_kind(ros2_here: Ros2) -> None:
    """The packages are sorted; an option keeps those with interfaces of its kind."""
    names = ros2_here('interface', 'packages').stdout.splitlines()
    assert names == sorted(names)
    assert {'std_msgs', 'std_srvs'} <= set(names)
    services = ros2_here('interface', 'packages', '--only-srvs').stdout.splitlines()
    assert 'std_srvs' in services
    assert 'std_msgs' not in services


def test_package_lists_its_interfaces(ros2_here: Ros2) -> None:
    """The interfaces of one package are listed by their full names."""
    result = ros2_here('interface', 'package', 'std_srvs')
    assert result.stdout == 'std_srvs/srv/Empty\nstd_srvs/srv/SetBool\nstd_srvs/srv/Trigger\n'
    assert ros2_here('interface', 'package', 'std_srvs', '-m').stdout == ''


def test_show_expands_nested_types(ros2_here: Ros2) -> None:
    """The types of fields are shown below them, without comments and under a tab."""
    result = ros2_here('interface', 'show', 'sensor_msgs/msg/JointState')
    comments, _, fields = result.stdout.partition('\n\nstd_msgs/Header header\n')
    assert comments.startswith('# This is a message that holds data to describe the state of')
    assert fields == (
        '\tbuiltin_interfaces/Time stamp\n\t\tint32 sec\n\t\tuint32 nanosec\n'
        '\tstring frame_id\n\n'
        'string[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort\n'
    )
    assert (result.returncode, result.stderr) == (0, '')


def test_show_without_comments(ros2_here: Ros2) -> None:
    """Without comments there are no empty lines either; defaults and types stay."""
    result = ros2_here('interface', 'show', 'geometry_msgs/msg/Pose', '--no-comments')
    assert result.stdout == (
        'Point position\n\tfloat64 x\n\tfloat64 y\n\tfloat64 z\n'
        'Quaternion orientation\n\tfloat64 x 0\n\tfloat64 y 0\n\tfloat64 z 0\n\tfloat64 w 1\n'
    )


def test_show_with_all_comments(ros2_here: Ros2) -> None:
    """Comments of nested definitions are shown when they are asked for."""
    output = ros2_here('interface', 'show', 'geometry_msgs/msg/Pose', '--all-comments').stdout
    assert '\t# This contains the position of a point in free space\n' in output


IDL = """// A corner.
module idl_msgs {
  module msg {
    struct Corner {
      @verbatim (language="comment", text="no // comment")
      double x;  /* in
        m */
    };
  };
};
"""


@pytest.fixture
def idl_package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Install a package with one interface in IDL, and one that uses it."""
    index = tmp_path / 'share/ament_index/resource_index'
    for kind, text in (('packages', ''), ('rosidl_interfaces', 'msg/Corner.idl\nmsg/Box.msg\n')):
        (index / kind).mkdir(parents=True)
        (index / kind / 'idl_msgs').write_text(text)
    folder = tmp_path / 'share/idl_msgs/msg'
    folder.mkdir(parents=True)
    (folder / 'Corner.idl').write_text(IDL)
    (folder / 'Box.msg').write_text('Corner low\n')
    monkeypatch.setenv('AMENT_PREFIX_PATH', f'{tmp_path}:{os.environ["AMENT_PREFIX_PATH"]}')


@pytest.mark.usefixtures('idl_package')
def test_interfaces_in_idl(ros2_here: Ros2) -> None:
    """They are listed as others, and shown as they are in the file."""
    listed = ros2_here('interface', 'package', 'idl_msgs').stdout.splitlines()
    assert listed == ['idl_msgs/msg/Box', 'idl_msgs/msg/Corner']
    shown = ros2_here('interface', 'show', 'idl_msgs/msg/Corner')
    assert (shown.returncode, shown.stdout, shown.stderr) == (0, IDL, '')
    bare = ros2_here('interface', 'show', 'idl_msgs/msg/Corner', '--no-comments').stdout
    assert bare == IDL.replace('// A corner.\n', '').replace('  /* in\n        m */', '')
    nested = ros2_here('interface', 'show', 'idl_msgs/msg/Box').stdout.splitlines()
    assert nested == ['Corner low', *(f'\t{line}' for line in bare.splitlines())]


def test_show_reads_the_type_from_stdin(ros2_here: Ros2, monkeypatch: pytest.MonkeyPatch) -> None:
    """A minus sign stands for the name on standard input."""
    monkeypatch.setattr('sys.stdin', io.StringIO('std_srvs/srv/Trigger\n'))
    lines = ros2_here('interface', 'show', '-').stdout.splitlines()
    assert [line.partition(' #')[0].rstrip() for line in lines] == [
        '---',
        'bool success',
        'string message',
    ]


def test_show_of_empty_stdin(ros2_here: Ros2, monkeypatch: pytest.MonkeyPatch) -> None:
    """An empty line names no interface."""
    monkeypatch.setattr('sys.stdin', io.StringIO('\nstd_srvs/srv/Trigger\n'))
    result = ros2_here('interface', 'show', '-')
    assert (result.returncode, result.stdout) == (1, '')
    assert result.stderr == 'Standard input has no interface name in its first line\n'


def test_show_of_a_terminal(ros2_here: Ros2, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where nothing is piped, the command says what it expects instead of waiting for it."""
    terminal = io.StringIO('std_srvs/srv/Trigger\n')
    monkeypatch.setattr(terminal, 'isatty', lambda: True, raising=False)
    monkeypatch.setattr('sys.stdin', terminal)
    result = ros2_here('interface', 'show', '-')
    assert (result.returncode, result.stdout) == (1, '')
    assert 'Write: echo std_msgs/msg/String | ros2 interface show -\n' in result.stderr


@pytest.mark.parametrize(
    ('type_name', 'error', 'hint'),
    [
        (
            'std_msgs/Header',
            "Invalid name 'std_msgs/Header'. Expected three parts separated by '/'",
            "Did you mean 'std_msgs/msg/Header'?",
        ),
        ('std_msg/msg/Header', "Unknown package 'std_msg'", "Did you mean 'std_msgs'?"),
        ('launch/msg/X', "Unknown package 'launch'", "The package 'launch' is installed, but"),
    ],
)
@pytest.mark.parametrize('verb', ['show', 'proto'])
def test_wrong_type_is_explained(
    verb: str, type_name: str, error: str, hint: str, ros2_here: Ros2
) -> None:
    """The error names the part of the name that is wrong, and then what may be meant."""
    result = ros2_here('interface', verb, type_name)
    first, second = result.stderr.splitlines()
    assert (result.returncode, result.stdout, first) == (1, '', error)
    assert second.startswith(hint)


def test_missing_interface_names_its_file(ros2_here: Ros2) -> None:
    """An interface that a package does not define is named with the file that would do it."""
    result = ros2_here('interface', 'show', 'std_msgs/msg/Strin')
    first, second = result.stderr.splitlines()
    assert first.startswith("Could not find the interface '/")
    assert first.endswith("/share/std_msgs/msg/Strin.idl'")
    assert (result.returncode, second) == (1, "Did you mean 'std_msgs/msg/String'?")


def test_unknown_package_is_an_error(ros2_here: Ros2) -> None:
    """A package without interfaces is unknown here."""
    result = ros2_here('interface', 'package', 'nope')
    assert (result.returncode, result.stderr.splitlines()[0]) == (1, "Unknown package 'nope'")


@pytest.mark.parametrize(
    ('type_name', 'text'),
    [
        ('geometry_msgs/msg/Point', 'x: 0.0\ny: 0.0\nz: 0.0\n'),
        ('std_srvs/srv/SetBool', 'data: false\n'),
    ],
)
def test_proto_is_yaml_in_quotes(type_name: str, text: str, ros2_here: Ros2) -> None:
    """The prototype of a message, or of a request, can be pasted into a command."""
    assert ros2_here('interface', 'proto', type_name).stdout == f'"{text}"\n'
    assert ros2_here('interface', 'proto', type_name, '--no-quotes').stdout == f'{text}\n'


@pytest.mark.parametrize(
    ('line', 'expected'),
    [
        ('Point[] points  # corners', 'here/msg/Point'),
        ('geometry_msgs/Pose pose', 'geometry_msgs/msg/Pose'),
        ('geometry_msgs/msg/Pose[<=3] poses', 'geometry_msgs/msg/Pose'),
        ('Header header', 'std_msgs/msg/Header'),
        ('string<=10 name', None),
        ('uint8 OK=0', None),
        ("string text 'Pose # x'", None),
        ('# Pose pose', None),
        ('---', None),
    ],
)
def test_types_of_fields(line: str, expected: str | None) -> None:
    """Only a field whose type is a message has one to expand."""
    assert field_type(line, 'here') == expected
