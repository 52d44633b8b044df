# SPDX-License-Identifier: Apache-2.0
"""Cases of section 3.12: nodes."""

from __future__ import annotations

import os
from typing import Any

import pytest

NODE = "Node(package='stub', executable='rec'{}),"


def _args(launch: Any, options: str, before: str = '') -> list[str]:
    """Return the arguments of a node with some options."""
    out = launch(before + NODE.format(f', {options}' if options else ''))
    assert out.status == 0
    args: list[str] = out.args[0]
    return args


def test_whole_command_line(launch: Any) -> None:
    """3.12 The parts of a node's command line stand in one exact order."""
    out = launch(
        """
        SetParameter('global', 1),
        SetParametersFromFile('global.yaml'),
        SetRemap('g', 'h'),
        SetParameter('global2', 'text'),
        PushRosNamespace('pushed'),
        Node(
            package='stub', executable='rec', name='n', namespace='own', exec_name='label',
            arguments=['-a', 'b c', LaunchConfiguration('x', default='')],
            ros_arguments=['--log-level', 'debug'],
            parameters=['own.yaml', {'p': 1}, Parameter('q', 2)],
            remappings=[('a', 'b'), (TextSubstitution(text='c'), ['d', 'e'])],
            prefix='env CASE_P=1',
        ),
        """,
        files={'global.yaml': '{}', 'own.yaml': '{}'},
    )
    assert out.args == [
        [
            *['-a', 'b c', '', '--ros-args', '--log-level', 'debug', '--ros-args'],
            *['-r', '__node:=n', '-r', '__ns:=/pushed/own'],
            *['-p', 'global:=1', '--params-file', 'HERE/global.yaml', '-p', 'global2:=text'],
            *['--params-file', 'own.yaml', '--params-file', 'PARAMS', '-p', 'q:=2'],
            *['-r', 'g:=h', '-r', 'a:=b', '-r', 'c:=de'],
        ]
    ]
    assert out.run.env['CASE_P'] == '1'
    assert '[INFO] [label-1]: process started with pid [N]' in out.lines


def test_ros_arguments_are_always_there(launch: Any) -> None:
    """3.12 --ros-args stands at the end of any command, also without anything behind it."""
    assert _args(launch, '') == ['--ros-args']
    assert _args(launch, "arguments=['x']") == ['x', '--ros-args']


def test_path_instead_of_package(launch: Any) -> None:
    """3.12 Without a package the executable is a path or command."""
    out = launch("Node(executable='rec', name='n'), Node(executable=['/bin/', 'true']),")
    assert out.run.args == ['--ros-args', '-r', '__node:=n']
    assert '[INFO] [true-2]: process has finished cleanly [pid N]' in out.lines


NAMES = [
    ("name='n'", '', ['__node:=n']),
    ("namespace='a'", '', ['__ns:=/a']),
    ("namespace=''", '', ['__ns:=/']),
    ("namespace='/'", '', ['__ns:=/']),
    ("namespace='/a/'", '', ['__ns:=/a']),
    ("namespace=['a', '/b']", '', ['__ns:=/a/b']),
    ('', "PushRosNamespace('p'),", ['__ns:=/p']),
    ("namespace='a'", "PushRosNamespace('p'),", ['__ns:=/p/a']),
    ("namespace='/a'", "PushRosNamespace('p'),", ['__ns:=/a']),
    ("namespace=''", "PushRosNamespace('p'),", ['__ns:=/p']),
    ("namespace='a'", "PushRosNamespace('p'), PushROSNamespace('q'),", ['__ns:=/p/q/a']),
    ("namespace='a'", "PushRosNamespace('/p'), PushROSNamespace('/q'),", ['__ns:=/q/a']),
    ('', "PushRosNamespace(''),", ['__ns:=/']),
    ('', "GroupAction([PushRosNamespace('p')]),", []),
    ('', "GroupAction([PushRosNamespace('p')], scoped=False),", ['__ns:=/p']),
]


def test_names(launch: Any) -> None:
    """3.12 Name and namespace are told if they are given, the latter absolute."""
    groups = ''.join(
        f"GroupAction([{before} Node(package='stub', executable='rec', arguments=['{n}'], "
        f'{options})]),\n'
        for n, (options, before, _) in enumerate(NAMES)
    )
    found = {args[0]: args[2:] for args in launch(groups).args}
    assert found == {
        str(n): [word for rule in rules for word in ('-r', rule)]
        for n, (_, _, rules) in enumerate(NAMES)
    }


@pytest.mark.parametrize(
    ('options', 'raw', 'error'),
    [
        ("name='1bad'", 'name=1bad, namespace=None', 'node name'),
        ("name='a/b'", 'name=a/b, namespace=None', 'node name'),
        ("namespace='bad-ns', name='n'", 'name=n, namespace=bad-ns', 'namespace'),
    ],
)
def test_invalid_names(options: str, raw: str, error: str, launch: Any) -> None:
    """3.12 An invalid name is an error with the values given, before anything starts."""
    out = launch(NODE.format('') + NODE.format(f', {options}'))
    assert (out.status, out.runs) == (1, [])
    logged = (
        'Error while expanding or validating node name or namespace for '
        f"'package=stub, executable=rec, {raw}':"
    )
    assert any(logged in line for line in out.lines if line.startswith('[ERROR]'))
    assert error in out.error
    assert '^' in out.error


def test_remappings(launch: Any) -> None:
    """3.12 Remappings are any tuples of two; their order is kept."""
    expected = ['-r', 'b:=c', '-r', 'a:=b']
    assert _args(launch, "remappings=(('b', 'c'), ('a', 'b'))")[1:] == expected
    assert _args(launch, "remappings={('b', 'c')}")[1:] == expected[:2]


def test_wrong_types(launch: Any) -> None:
    """3.12 A node takes keywords of the right types only, and needs an executable."""
    node = "Node(package='stub', executable='rec', {})"
    errors = launch.errors(
        node.format("remappings=[['a', 'b']]"),
        node.format("remappings=[('a', 'b', 'c')]"),
        node.format("parameters={'a': 1}"),
        node.format("parameters='file.yaml'"),
        # Better than the genuine one, which makes a word of each character.
        node.format("arguments='-d x'"),
        node.format("bogus='x'"),
        node.format("node_name='x'"),
        "Node('stub', 'rec')",
        "Node(package='stub')",
    )
    assert all(error.startswith('TypeError: ') for error in errors), errors


@pytest.mark.parametrize(
    ('options', 'error'),
    [
        ("package='stub', executable='no'", "executable 'no' not found on the libexec directory"),
        ("package='no_such', executable='x'", "package 'no_such' not found, searching: ['PREFIX'"),
    ],
)
def test_missing_executables(options: str, error: str, launch: Any) -> None:
    """3.12 A package or executable that does not exist is an error."""
    out = launch(f'Node({options}),')
    assert out.status == 1
    assert error in out.error


def test_duplicate_names(launch: Any) -> None:
    """3.12 The second node with the same full name is told, before it starts."""
    out = launch(
        """
        Node(package='stub', executable='rec', name='a', namespace=''),
        Node(package='stub', executable='rec', name='a', namespace='/'),
        Node(package='stub', executable='rec', name='a', namespace='other'),
        Node(package='stub', executable='rec', name='a'),
        Node(package='stub', executable='rec', name='a'),
        LogInfo(msg='walked'),
        """
    )
    told = [line for line in out.lines if 'there are now' in line]
    assert told == [
        '[WARNING] [rec-2]: there are now at least 2 nodes with the name /a created within this '
        'launch context'
    ]
    assert out.lines.index(told[0]) < out.lines.index('[INFO] [launch.user]: walked')


def test_attributes(launch: Any) -> None:
    """3.12 A node knows its names when it has been visited."""
    out = launch(
        """
        it = Node(package='stub', executable='rec', name='n', namespace='a',
                  remappings=[('x', 'y')])
        bare = Node(package='stub', executable='rec')
        try:
            it.node_name
        except RuntimeError:
            print('not yet', flush=True)

        def look(context):
            print(it.node_name, it.node_package, it.node_executable, it.expanded_node_namespace)
            print(it.expanded_remapping_rules, it.is_node_name_fully_specified())
            print(bare.node_name, bare.expanded_node_namespace)
            print(bare.is_node_name_fully_specified(), flush=True)
        ---
        it, bare, OpaqueFunction(function=look),
        """
    )
    printed = [line for line in out.tidy(out.stdout).splitlines() if line[:2] not in ('[I', '[W')]
    assert printed == [
        *['not yet', '/a/n stub rec /a', "[('x', 'y')] True"],
        *['<node_namespace_unspecified>/<node_name_unspecified> <node_namespace_unspecified>'],
        'False',
    ]


EXTENSION = """
from launch_ros.actions.node import NodeActionExtension


class Adds(NodeActionExtension):
    def prepare_for_execute(self, context, ros_specific_arguments, node_action):
        return ['from', 'the extension'], ros_specific_arguments
"""


def test_extensions(launch: Any) -> None:
    """3.12 A package can add to the commands of nodes by an entry point."""
    folder = 'site/case_extension-1.0.dist-info'
    launch.write('site/case_extension.py', EXTENSION, wrap=False)
    launch.write(f'{folder}/METADATA', 'Name: case_extension\nVersion: 1.0\n')
    launch.write(
        f'{folder}/entry_points.txt', '[launch_ros.node_action]\ncase = case_extension:Adds\n'
    )
    path = f'{launch.here / "site"}:{os.environ.get("PYTHONPATH", "")}'
    out = launch(NODE.format(", arguments=['own']"), PYTHONPATH=path)
    assert out.status == 0
    assert out.run.args[:1] == ['own']
    assert {'from', 'the extension'} <= set(out.run.args)
