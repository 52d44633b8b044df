# SPDX-License-Identifier: Apache-2.0
"""Tests of the verbs of `ros2 param` with a real node."""

from collections.abc import Callable
from pathlib import Path
import signal
from subprocess import CompletedProcess
from typing import Any

import pytest
from rcl_interfaces.msg import ParameterType
from ros2param.api.file import flatten, matches, nest
from ros2param.api.values import parse_value, to_plain_value

Ros2 = Callable[..., CompletedProcess[str]]
Start = Callable[..., Any]

OWN = [
    'enabled',
    'fingers.count',
    'fingers.names',
    'gains',
    'label',
    'spare',
    'speed',
    'start_type_description_service',
    'use_sim_time',
]


def test_list_of_one_node(ros2_robot: Ros2) -> None:
    """The parameters of a node are sorted and indented; the slash may be missing."""
    result = ros2_robot('param', 'list', 'robot1/arm')
    assert result.stdout == ''.join(f'  {name}\n' for name in OWN)
    assert (result.returncode, result.stderr) == (0, '')


def test_list_of_all_nodes(ros2_robot: Ros2) -> None:
    """Without a node, the names of nodes are headings; nodes without parameters are left out."""
    lines = ros2_robot('param', 'list').stdout.splitlines()
    assert [line for line in lines if not line.startswith('  ')] == ['/lamp:', '/robot1/arm:']
    own = lines.index('/robot1/arm:') + 1
    assert lines[own:] == [f'  {name}' for name in OWN]


def test_list_is_filtered_and_typed(ros2_robot: Ros2) -> None:
    """Prefixes and a regular expression choose; types are shown in parentheses."""
    words = ('param', 'list', '/robot1/arm', '--param-type')
    chosen = ros2_robot(*words, '--param-prefixes', 'fingers').stdout
    assert chosen == '  fingers.count (type: integer)\n  fingers.names (type: string array)\n'
    assert ros2_robot(*words, '--filter', '^s.*d$').stdout == '  speed (type: double)\n'


@pytest.mark.parametrize(
    ('name', 'output'),
    [
        ('speed', 'Double value is: 0.5'),
        ('fingers.count', 'Integer value is: 4'),
        ('fingers.names', "String values are: ['thumb', 'index']"),
        ('enabled', 'Boolean value is: True'),
        ('label', 'String value is: left arm'),
        ('gains', 'Double values are: [1.0, 2.5]'),
    ],
)
def test_get_names_the_type(name: str, output: str, ros2_robot: Ros2) -> None:
    """A value is printed with its type, or alone."""
    result = ros2_robot('param', 'get', '/robot1/arm', name)
    assert (result.returncode, result.stdout, result.stderr) == (0, f'{output}\n', '')
    alone = ros2_robot('param', 'get', '/robot1/arm', name, '--hide-type')
    assert alone.stdout == f'{output.partition(": ")[2]}\n'


def test_get_of_unknown_parameter(ros2_robot: Ros2) -> None:
    """A parameter that is not set is an error, which names the one that is meant."""
    result = ros2_robot('param', 'get', '/robot1/arm', 'sped')
    assert (result.returncode, result.stdout) == (1, '')
    assert result.stderr == (
        "Parameter not set\nThe node '/robot1/arm' has no parameter 'sped'. "
        "Did you mean 'speed'?\n"
    )


@pytest.mark.parametrize(
    'words',
    [
        ['list'],
        ['get', 'speed'],
        ['set', 'speed', '1'],
        ['describe', 'speed'],
        ['dump'],
        ['load', '/nope.yaml'],
        ['delete', 'speed'],
    ],
)
def test_unknown_node_is_an_error(words: list[str], ros2_robot: Ros2) -> None:
    """Each verb says that the node is not there, and which one is close."""
    result = ros2_robot('param', words[0], 'robot1/amr', *words[1:], '--timeout', '0.1')
    assert (result.returncode, result.stdout) == (1, '')
    assert result.stderr == "Node not found\nDid you mean '/robot1/arm'?\n"


def test_node_without_parameters_is_explained(ros2_robot: Ros2) -> None:
    """A node that was started without parameter services is told from one that is missing."""
    result = ros2_robot('param', 'get', '/_ghost', 'x', '--timeout', '0.2')
    assert result.returncode == 1
    assert result.stderr.startswith("The node '/_ghost' has no parameter services")


def test_set_and_get(ros2_robot: Ros2) -> None:
    """A value that is set is there, and the command says so."""
    for value in ('1.5', '0.5'):
        result = ros2_robot('param', 'set', '/robot1/arm', 'speed', value)
        assert (result.returncode, result.stdout, result.stderr) == (
            0,
            'Set parameter successful\n',
            '',
        )
        assert ros2_robot('param', 'get', '/robot1/arm', 'speed', '--hide-type').stdout == (
            f'{value}\n'
        )


@pytest.mark.parametrize(
    ('name', 'value', 'reason', 'hint'),
    [
        ('label', 'right', 'this is the left arm', None),
        (
            'speed',
            '1',
            'Wrong parameter type',
            "'speed' is of the type double, but 1 is integer. Write 1.0.",
        ),
        (
            'gains',
            '[1, 2]',
            'Wrong parameter type',
            "'gains' is of the type double array, but [1, 2] is integer array. Write [1.0, 2.0].",
        ),
        (
            'label',
            '3',
            'Wrong parameter type',
            "'label' is of the type string, but 3 is integer. Quotes make it a string: ",
        ),
        ('speed', '-3.5', 'Parameter speed out of range', None),
        ('fingers.count', '2', 'Trying to set a read-only parameter: fingers.count.', None),
        ('sped', '2.0', '', "The node '/robot1/arm' has no parameter 'sped'. Did you mean 'spee"),
    ],
)
def test_refused_value_is_explained(
    name: str, value: str, reason: str, hint: str | None, ros2_robot: Ros2
) -> None:
    """A refusal is told with its reason on stderr, and is no error."""
    result = ros2_robot('param', 'set', '/robot1/arm', name, value)
    first, *rest = result.stderr.splitlines()
    assert (result.returncode, result.stdout) == (0, '')
    assert first.startswith(f'Setting parameter failed: {reason}')
    assert len(rest) == (hint is not None)
    assert not rest or rest[0].startswith(hint)


def test_describe(ros2_robot: Ros2) -> None:
    """The description shows type, purpose and limits; unknown names are told on stderr."""
    names = ('speed', 'fingers.count', 'enabled', 'sped')
    result = ros2_robot('param', 'describe', '/robot1/arm', *names)
    assert result.stdout == (
        'Parameter name: speed\n  Type: double\n  Description: Speed in m/s\n  Constraints:\n'
        '    Min value: 0.0\n    Max value: 2.0\n'
        'Parameter name: fingers.count\n  Type: integer\n  Constraints:\n'
        '    Read only: true\n    Min value: 0\n    Max value: 10\n    Step: 2\n'
        'Parameter name: enabled\n  Type: boolean\n  Constraints:\n'
    )
    assert result.returncode == 0
    assert result.stderr == (
        "The node '/robot1/arm' has no parameter 'sped'. Did you mean 'speed'?\n"
    )


def test_dump_is_a_parameter_file(ros2_robot: Ros2) -> None:
    """The dump has dotted names as nested mappings, and an empty line at the end."""
    result = ros2_robot('param', 'dump', '/robot1/arm')
    assert result.stdout == (
        '/robot1/arm:\n  ros__parameters:\n    enabled: true\n    fingers:\n      count: 4\n'
        '      names:\n      - thumb\n      - index\n    gains:\n    - 1.0\n    - 2.5\n'
        '    label: left arm\n    spare: 1\n    speed: 0.5\n'
        '    start_type_description_service: true\n    use_sim_time: false\n\n'
    )


def test_load_reports_each_parameter(tmp_path: Path, ros2_robot: Ros2) -> None:
    """What a file has for the node is set one by one; its own section wins."""
    path = tmp_path / 'arm.yaml'
    path.write_text(
        '/**:\n  ros__parameters: {speed: 0.75, sped: 1.0, label: right}\n'
        '/robot1/arm:\n  ros__parameters: {speed: 1.25, fingers: {names: [a]}}\n'
    )
    result = ros2_robot('param', 'load', '/robot1/arm', str(path))
    assert result.stdout == (
        'Set parameter speed successful\nSet parameter fingers.names successful\n'
    )
    assert result.stderr == (
        'Set parameter sped failed: Invalid access to undeclared parameter(s): []\n'
        "The node '/robot1/arm' has no parameter 'sped'. Did you mean 'speed'?\n"
        'Set parameter label failed: this is the left arm\n'
    )
    assert result.returncode == 0
    path.write_text(
        '/**:\n  ros__parameters: {label: right}\n'
        'robot1:\n  arm:\n    ros__parameters: {speed: 0.5, fingers.names: [thumb, index]}\n'
    )
    again = ros2_robot('param', 'load', '/robot1/arm', str(path), '--no-use-wildcard')
    assert (again.returncode, again.stderr) == (0, '')


@pytest.mark.parametrize(
    ('text', 'error'),
    [
        (None, 'cannot be read: '),
        ('/other: {ros__parameters: {}}', "only for nodes: ['/other']"),
        ('a: [', 'is not valid YAML: '),
        ('', 'has no node names'),
        ('/robot1/arm: 3', "has the value 3 for '/robot1/arm', which is not below 'ros__para"),
        ('/a: {ros_parameters: {b: 1}}', "which is not below 'ros__parameters': 'ros_parameters'"),
        ('/robot1/arm: {ros__parameters: [1]}', "below 'ros__parameters' of '/robot1/arm', not"),
        ('/**: {ros__parameters: {speed: }}', "has no value for the parameter 'speed'"),
        ('/**: {ros__parameters: {n: 9999999999999999999}}', "value for the parameter 'n': 99"),
        ('- 1', 'has no node names'),
    ],
)
def test_wrong_file_is_explained(
    text: str | None, error: str, tmp_path: Path, ros2_robot: Ros2
) -> None:
    """A file that cannot be used is a sentence."""
    path = tmp_path / 'arm.yaml'
    if text is not None:
        path.write_text(text)
    result = ros2_robot('param', 'load', '/robot1/arm', str(path))
    assert (result.returncode, result.stdout) == (1, '')
    assert result.stderr.startswith(f"The parameter file '{path}' ")
    assert error in result.stderr


def test_delete(ros2_robot: Ros2) -> None:
    """A parameter that the node can do without is deleted, another is not."""
    done = ros2_robot('param', 'delete', '/robot1/arm', 'spare')
    assert (done.returncode, done.stdout) == (0, 'Deleted parameter successfully\n')
    ros2_robot('param', 'set', '/robot1/arm', 'spare', '1')
    refused = ros2_robot('param', 'delete', '/robot1/arm', 'fingers.count')
    assert (refused.returncode, refused.stdout) == (0, '')
    assert refused.stderr.startswith('Deleting parameter failed: ')


def test_interrupt_is_quiet(start_at_robot: Start) -> None:
    """Ctrl-C while a node is waited for ends with the status of the signal."""
    process = start_at_robot('param', 'get', '/nope', 'x', '--timeout', '60')
    assert process.stderr.readline() == "Still waiting for the node '/nope' (Ctrl-C to stop)\n"
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=100) == 2
    assert process.stderr.read() == ''


@pytest.mark.parametrize(
    ('text', 'kind', 'plain'),
    [
        ('3', ParameterType.PARAMETER_INTEGER, 3),
        ('-1.5', ParameterType.PARAMETER_DOUBLE, -1.5),
        ('true', ParameterType.PARAMETER_BOOL, True),
        ("'3'", ParameterType.PARAMETER_STRING, '3'),
        ('[1, 2]', ParameterType.PARAMETER_INTEGER_ARRAY, [1, 2]),
        ('[1, 2.5]', ParameterType.PARAMETER_DOUBLE_ARRAY, [1.0, 2.5]),
        ('[a, b]', ParameterType.PARAMETER_STRING_ARRAY, ['a', 'b']),
        ('[true]', ParameterType.PARAMETER_BOOL_ARRAY, [True]),
        ('[]', ParameterType.PARAMETER_BOOL_ARRAY, []),
        ('[1, a]', ParameterType.PARAMETER_STRING, '[1, a]'),
        ('{a: 1}', ParameterType.PARAMETER_STRING, '{a: 1}'),
        ('2020-01-01', ParameterType.PARAMETER_STRING, '2020-01-01'),
        ('"', ParameterType.PARAMETER_STRING, '"'),
        ('', ParameterType.PARAMETER_STRING, ''),
    ],
)
def test_values_are_typed_by_yaml(text: str, kind: int, plain: Any) -> None:
    """A text becomes a value of the type that YAML sees in it."""
    value = parse_value(text)
    assert (value.type, to_plain_value(value)) == (kind, plain)


def test_number_out_of_range_is_refused() -> None:
    """A number of more than 64 bits is a sentence."""
    with pytest.raises(RuntimeError, match='is too large'):
        parse_value(str(2**63))
    with pytest.raises(RuntimeError, match='is too large'):
        parse_value(f'[1.5, {10**400}]')


def test_nesting_and_back() -> None:
    """Dotted names nest, except where a name is a parameter and a prefix."""
    flat = {'a': 1, 'a.b': 2, 'c.d.e': 3, 'c.f': [4]}
    assert nest(flat) == {'a': 1, 'a.b': 2, 'c': {'d': {'e': 3}, 'f': [4]}}
    assert dict(flatten(nest(flat))) == flat


@pytest.mark.parametrize(
    ('pattern', 'expected'),
    [
        ('/**', True),
        ('/*/arm', True),
        ('/**/arm', True),
        ('/robot1/**', True),
        ('/*', False),
        ('/robot2/*', False),
        ('/robot1/arm/**', True),
    ],
)
def test_wildcards(pattern: str, expected: bool) -> None:
    """One star stands for one part of a name, two for any number of parts."""
    assert matches(pattern, '/robot1/arm') is expected
