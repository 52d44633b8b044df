# SPDX-License-Identifier: Apache-2.0
"""Cases of section 3.13: parameters, remappings and namespaces of nodes."""

from __future__ import annotations

import math
from typing import Any

import pytest
import yaml


def _node(parameters: str, more: str = '') -> str:
    return f"Node(package='stub', executable='rec', parameters={parameters}{more}),"


def _values(launch: Any, parameters: str, before: str = '') -> dict[str, Any]:
    """Return what a node with these parameters finds in its file."""
    out = launch(before + _node(parameters))
    assert out.status == 0
    (params,) = out.run.params
    values: dict[str, Any] = params['/**']['ros__parameters']
    return values


@pytest.mark.parametrize(
    ('more', 'before', 'key'),
    [
        ('', '', '/**'),
        (", name='n'", '', '/**'),
        (", namespace='a'", '', '/**'),
        (", name='n', namespace='a'", '', '/a/n'),
        (", name='n', namespace=''", '', '/n'),
        (", name='n'", "PushRosNamespace('p'),", '/p/n'),
    ],
)
def test_dictionary(more: str, before: str, key: str, launch: Any) -> None:
    """3.13 A dictionary becomes a file for the node if both its names are known, else for all."""
    out = launch(before + _node("[{'b': 1, 'a': {'y': 2, 'x': {'z': 'deep'}}}]", more))
    assert out.run.params == [{key: {'ros__parameters': {'a.x.z': 'deep', 'a.y': 2, 'b': 1}}}]
    (file,) = (word for word in out.run.args if 'launch_params_' in word)
    assert file.startswith(f'{out.here}/tmp/launch_params_')


def test_text_of_the_file(launch: Any) -> None:
    """3.13 The file has a line for each sorted key, and no tags of Python (section 6)."""
    out = launch(
        _node("[{'b': [1, 2], 'a': ('x', 'y'), 'c': '1'}]"),
        REC_THEN='for x; do [ -f "$x" ] && cat "$x" >text; done',
    )
    lines = (out.here / 'text').read_text().splitlines()
    assert [line.strip()[:3].strip("':") for line in lines[2:]] == ['a', 'b', 'c']
    assert '!!' not in ''.join(lines)


def test_several_elements(launch: Any) -> None:
    """3.13 Each dictionary has a file of its own; the order of all elements is kept."""
    out = launch(
        'from pathlib import Path\n'
        'from launch_ros.parameter_descriptions import ParameterFile\n---\n'
        + _node(
            "[{'a': 1}, 'own.yaml', {'a': 2}, Parameter('p', 5), Path('own.yaml'), "
            "ParameterFile('./own.yaml'), ['own', TextSubstitution(text='.yaml')]]"
        ),
        files={'own.yaml': '{}'},
    )
    assert out.args[0] == [
        *['--ros-args', '--params-file', 'PARAMS', '--params-file', 'own.yaml'],
        *['--params-file', 'PARAMS', '-p', 'p:=5', '--params-file', 'own.yaml'],
        *['--params-file', './own.yaml', '--params-file', 'own.yaml'],
    ]
    own = [each['/**']['ros__parameters']['a'] for each in out.run.params if each]
    assert own == [1, 2]


def test_temporary_files(launch: Any) -> None:
    """3.13 The temporary files are there as long as the launch (section 6)."""
    out = launch(_node("[{'a': 1}]", ', output="screen"'), REC_THEN='ls tmp')
    assert any('launch_params_' in line for line in out.lines)
    assert list((out.here / 'tmp').iterdir()) == []


def test_file_that_is_none(launch: Any) -> None:
    """3.13 A path that is no file is a warning, and left out."""
    out = launch(_node("['no.yaml', {'a': 1}]"))
    assert out.status == 0
    line = '[WARNING] [launch_ros.actions.node]: Parameter file path is not a file: no.yaml'
    assert line in out.lines
    assert out.args == [['--ros-args', '--params-file', 'PARAMS']]


@pytest.mark.parametrize(
    ('value', 'expected'),
    [
        ('True', True),
        ("'text'", 'text'),
        ('[1, 2]', [1, 2]),
        ("LaunchConfiguration('x', default='7')", 7),
        ("TextSubstitution(text='7'), value_type=str", '7'),
        ("'7', value_type=int", 7),
    ],
)
def test_single_parameter(value: str, expected: Any, launch: Any) -> None:
    """3.13 A single parameter stands on the command line, as YAML."""
    out = launch(_node(f"[Parameter('p', {value})]"))
    name, _, text = out.run.args[2].partition(':=')
    assert out.run.args[:2] == ['--ros-args', '-p']
    assert (name, yaml.safe_load(text)) == ('p', expected)


def test_typing_of_plain_values(launch: Any) -> None:
    """3.13 Plain values keep their types; a str is a string, whatever it looks like."""
    values = {
        'bool': True,
        'int': 3,
        'negative': -1,
        'float': 1.0,
        'bytes': b'ab',
        'text': 'hello world',
        'one': '1.0',
        'yes': 'yes',
        'true': 'true',
        'empty': '',
        'list': '[1, 2]',
        'multi': 'a\nb: c\n',
        'ints': [1, 2],
        'floats': [1.0, 2.5],
        'bools': [True, False],
        'texts': ['1', 'two', 'true', ''],
    }
    assert _values(launch, f'[{values!r}]') == values
    more = {'mix': [1, 2.5], 'tuple': (1, 2)}
    assert _values(launch, f'[{more!r}]') == {'mix': [1.0, 2.5], 'tuple': [1, 2]}


def test_typing_of_substitutions(launch: Any) -> None:
    """3.13 What a substitution gives is typed by the rules of YAML."""
    texts = {
        'int': ('5', 5),
        'float': ('5.0', 5.0),
        'true': ('true', True),
        'yes': ('yes', True),
        'text': ('hello', 'hello'),
        'list': ('[1, 2]', [1, 2]),
        'texts': ('[a, b]', ['a', 'b']),
        'empty': ('', ''),
        'quoted': ("'5'", '5'),
    }
    before = ''.join(
        f'SetLaunchConfiguration({name!r}, {text!r}),' for name, (text, _) in texts.items()
    )
    entries = ', '.join(f'{name!r}: LaunchConfiguration({name!r})' for name in texts)
    found = _values(launch, f'[{{{entries}}}]', before)
    assert found == {name: value for name, (_, value) in texts.items()}
    found = _values(
        launch,
        "[{'joined': [LaunchConfiguration('a'), '2'], 'e': LaunchConfiguration('e'),"
        " 'several': [[LaunchConfiguration('a'), '2'], ['3']],"
        " ('k', LaunchConfiguration('a')): 'key', LaunchConfiguration('a'): 'too'}]",
        "SetLaunchConfiguration('a', '1'), SetLaunchConfiguration('e', '1e3'),",
    )
    exponent = found.pop('e')
    assert math.isclose(float(exponent), 1000.0)
    assert found == {'joined': 12, 'several': [12, 3], 'k1': 'key', '1': 'too'} or found == {
        'joined': 12,
        'several': [12, 3],
        'k1': 'key',
        1: 'too',
    }


FAILURES = [
    (
        "TextSubstitution(text='{a: 1}')",
        'Allowed value types are bytes, bool, int, float, str',
    ),
    (
        "TextSubstitution(text='a: b: c')",
        'Unable to parse the value of parameter a as yaml. If the parameter is meant to be a '
        'string, try wrapping it in launch_ros.parameter_descriptions.ParameterValue(value, '
        'value_type=str)',
    ),
    ("TextSubstitution(text='null')", 'NoneType'),
    ("TextSubstitution(text='[1, a]')", 'items of uniform type'),
    (
        "[1, 'a']",
        'Expected a non-empty sequence, with items of uniform type.',
    ),
    ("[1, 'a']", 'Got inconsistent input for "a"'),
    ('[True, 1]', 'items of uniform type'),
    ('[]', 'Expected a non-empty sequence'),
    ('None', 'Unexpected type for parameter value None'),
    ('object()', 'Unexpected type for parameter value'),
]


def test_values_that_fail(launch: Any) -> None:
    """3.13 A value that no parameter can have is an error that says why."""
    nodes = [_node(f"[{{'a': {value}}}]").rstrip(',') for value, _ in FAILURES]
    for (_, text), error in zip(FAILURES, launch.errors(*nodes)):
        assert error.startswith('TypeError: ')
        assert text in error


def test_parameter_value(launch: Any) -> None:
    """3.13 ParameterValue gives the type, or leaves it to YAML; it can be imported twice."""
    before = """
from typing import List
from launch_ros.descriptions import ParameterValue as Same
from launch_ros.parameter_descriptions import ParameterValue as Value
x = LaunchConfiguration('x', default='1')
assert Same is Value
---
"""
    assert _values(
        launch,
        "[{'s': Value(x, value_type=str), 'i': Value(x, value_type=int), 'y': Value(x),"
        " 'f': Value(x, value_type=float), 'b': Value(x, value_type=bool),"
        " 'l': Value('[a, b]', value_type=List[str]), 'u': Value('a: b', value_type=str),"
        " 'li': Value(['[', x, ']'], value_type=List[int])}]",
        before,
    ) == {
        's': '1',
        'i': 1,
        'y': 1,
        'f': 1.0,
        'b': True,
        'l': ['a', 'b'],
        'u': 'a: b',
        'li': [1],
    }


def test_value_is_evaluated_once(launch: Any) -> None:
    """3.13 One ParameterValue in two nodes has the value that it had first."""
    out = launch(
        """
        from launch_ros.parameter_descriptions import ParameterValue
        value = ParameterValue(LaunchConfiguration('x'), value_type=str)
        ---
        SetLaunchConfiguration('x', 'first'),
        Node(package='stub', executable='rec', parameters=[{'a': value}]),
        SetLaunchConfiguration('x', 'second'),
        Node(package='stub', executable='rec', parameters=[{'a': value}]),
        """
    )
    values = [run.params[0]['/**']['ros__parameters']['a'] for run in out.runs]
    assert values == ['first', 'first']


def test_file_with_substitutions(launch: Any) -> None:
    """3.13 With allow_substs the substitutions in a file are performed."""
    text = (
        'from launch_ros.parameter_descriptions import ParameterFile\n---\n'
        "SetLaunchConfiguration('x', '5'),"
    ) + _node("[ParameterFile('own.yaml', allow_substs=True)]")
    out = launch(
        text,
        files={'own.yaml': '/**:\n  ros__parameters:\n    a: $(var x)\n    b: "$(var x)"\n'},
    )
    assert out.status == 0
    assert out.run.params == [{'/**': {'ros__parameters': {'a': 5, 'b': '5'}}}]
    out = launch(text, files={'own.yaml': 'a: [$(var x)\n'})
    assert out.status == 1
    assert 'The substituted parameter file is not a valid yaml file' in out.error


def test_allow_substs_is_a_bool(launch: Any) -> None:
    """3.13 Only a bool can allow substitutions."""
    values = ("TextSubstitution(text='true')", "'true'", '1')
    errors = launch.errors(
        *(f"ParameterFile('x', allow_substs={value})" for value in values),
        before='from launch_ros.parameter_descriptions import ParameterFile',
    )
    assert all(error.startswith('TypeError: ') for error in errors), errors


def test_parameters_of_all_nodes(launch: Any) -> None:
    """3.13 SetParameter and its like come before what is the node's own, in their order."""
    out = launch(
        """
        SetParameter('sim', True),
        SetParameter(name='text', value='true'),
        SetParameter('typed', LaunchConfiguration('x', default='5')),
        SetParameter('float', 1.5),
        SetParameter('list', [1, 2]),
        SetParameter(['k', LaunchConfiguration('y', default='ey')], 'v'),
        SetParametersFromFile('all.yaml'),
        SetParameter('last', 'a b'),
        SetRemap(src='a', dst=['b', 'c']),
        Node(package='stub', executable='rec'),
        """,
        files={'all.yaml': '{}'},
    )
    args = out.args[0]
    assert args == [
        *['--ros-args', '-p', 'sim:=True', '-p', 'text:=true', '-p', 'typed:=5'],
        # Section 6: a list is written as ROS reads it.
        *['-p', 'float:=1.5', '-p', 'list:=[1, 2]', '-p', 'key:=v'],
        *['--params-file', 'HERE/all.yaml', '-p', 'last:=a b', '-r', 'a:=bc'],
    ]


def test_file_for_all_must_exist(launch: Any) -> None:
    """3.13 A file of parameters for all nodes must exist."""
    out = launch("SetParametersFromFile('no.yaml'),")
    assert out.status == 1
    assert 'no.yaml' in out.error


def test_end_of_a_scope(launch: Any) -> None:
    """3.13 What a group sets for all nodes ends with it (section 6)."""
    out = launch(
        """
        SetParameter('outer', 1),
        SetRemap('o', 'p'),
        GroupAction([
            SetParameter('inner', 2),
            SetRemap('i', 'j'),
            SetParametersFromFile('all.yaml'),
            Node(package='stub', executable='rec', arguments=['in']),
        ]),
        Node(package='stub', executable='rec', arguments=['out']),
        """,
        files={'all.yaml': '{}'},
    )
    assert out.args == [
        [
            *['in', '--ros-args', '-p', 'outer:=1', '-p', 'inner:=2'],
            *['--params-file', 'HERE/all.yaml', '-r', 'o:=p', '-r', 'i:=j'],
        ],
        ['out', '--ros-args', '-p', 'outer:=1', '-r', 'o:=p'],
    ]


def test_time_and_logs(launch: Any) -> None:
    """3.13 SetUseSimTime is for the launch only; SetROSLogDir changes the folder of logs."""
    out = launch(
        """
        SetUseSimTime(True),
        SetUseSimTime(False),
        SetROSLogDir('sub'),
        Node(package='stub', executable='rec', arguments=['1']),
        SetROSLogDir('/tmp/absolute'),
        Node(package='stub', executable='rec', arguments=['2']),
        """
    )
    assert (out.status, out.args) == (0, [['1', '--ros-args'], ['2', '--ros-args']])
    folders = {run.args[0]: run.env['ROS_LOG_DIR'] for run in out.runs}
    assert folders == {'1': str(out.here / 'log/sub'), '2': '/tmp/absolute'}


def test_invalid_namespace(launch: Any) -> None:
    """3.13 A namespace that is invalid is an error with both parts."""
    out = launch("PushRosNamespace('1bad'),")
    assert out.status == 1
    assert out.error.startswith(
        "The resulting namespace is invalid: [previous_namespace='None', pushed_namespace='1bad']"
    )
    out = launch("PushRosNamespace('a'), PushRosNamespace('b c'),")
    assert "[previous_namespace='/a', pushed_namespace='b c']" in out.error


def test_namespace_is_a_configuration(launch: Any) -> None:
    """3.13 A pushed namespace is the launch configuration ros_namespace."""
    out = launch(
        """
        assert_same = PushRosNamespace is PushROSNamespace
        ---
        LogInfo(msg=str(assert_same)),
        PushRosNamespace(namespace=['a', LaunchConfiguration('x', default='b')]),
        LogInfo(msg=LaunchConfiguration('ros_namespace')),
        """
    )
    assert out.said == ['True', '/ab']
