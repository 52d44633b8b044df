# SPDX-License-Identifier: Apache-2.0
"""What a container would be asked for, without any container."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from launch import LaunchContext
from launch.substitutions import LaunchConfiguration, TextSubstitution
from launch_ros.actions import PushRosNamespace, SetParameter, SetParametersFromFile, SetRemap
from launch_ros.actions._load_request import build_load_request, LoadRequest
from launch_ros.descriptions import ComposableNode, Parameter, ParameterValue
from launch_ros.utilities import evaluate_parameters, normalize_parameters, to_parameters_list
from launch_ros.utilities.parameter_list import matches, read_parameter_file
import pytest

FILE = """
/**:
  ros__parameters: {any: 1}
/*:
  ros__parameters: {root: 1}
/**/talker:
  ros__parameters: {talker: 1}
/robot/*:
  ros__parameters: {robot: 1}
/robot/**:
  ros__parameters: {below_robot: 1}
robot:
  talker:
    ros__parameters: {nested: {deep: [1, 2.5]}}
other:
  ros__parameters: {other: 1}
"""


def _request(context: LaunchContext, *before: Any, **kwargs: Any) -> LoadRequest:
    for entity in before:
        entity.visit(context)
    return build_load_request(context, ComposableNode(package='p', plugin='P', **kwargs))


@pytest.mark.parametrize(
    'pushed, name, namespace, expected',
    [
        (None, None, None, (None, None)),
        (None, 'n', None, ('n', None)),
        (None, 'n', 'a', ('n', '/a')),
        (None, 'n', '', ('n', '/')),
        ('r', 'n', None, ('n', '/r')),
        ('r', None, 'a', (None, '/r/a')),
        ('r', 'n', '/a', ('n', '/a')),
    ],
)
def test_names(context: LaunchContext, pushed: Any, name: Any, namespace: Any, expected: Any):
    """The namespace is below the one that was pushed; what is not given stays open."""
    before = [] if pushed is None else [PushRosNamespace(pushed)]
    names = _request(context, *before, name=name, namespace=namespace).names
    assert (names.name, names.namespace) == expected


def test_what_holds_for_all_nodes(context: LaunchContext, tmp_path: Path) -> None:
    """Parameters, files and remappings of all nodes come before the node's own."""
    path = tmp_path / 'p.yaml'
    path.write_text(FILE)
    request = _request(
        context,
        SetParameter('a', 1),
        SetParametersFromFile(str(path)),
        SetRemap('x', 'y'),
        name='n',
        parameters=[{'b': TextSubstitution(text='2')}, Parameter('c', True)],
        remappings=[('in', LaunchConfiguration('target', default='out'))],
    )
    assert request.parameters == [('a', 1), ('any', 1), ('root', 1), ('b', 2), ('c', True)]
    assert request.remap_rules == ['x:=y', 'in:=out']


def test_file_that_is_missing(context: LaunchContext, tmp_path: Path) -> None:
    """A node is not loaded without the parameters that it is to have; a typo is recognized."""
    (tmp_path / 'param.yaml').touch()
    with pytest.raises(FileNotFoundError, match=r"params.yaml' does not exist. .*'param.yaml'"):
        _request(context, parameters=[str(tmp_path / 'params.yaml'), {'a': 1}])


def test_keys_outside_of_parameters(
    context: LaunchContext, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    """What is for no node is ignored, and that is said once for all nodes that get the file."""
    path = tmp_path / 'p.yaml'
    path.write_text('/n:\n  ros__parameters: {a: 1}\n  b: 2\nc: [3]\n')
    for _ in range(2):
        assert _request(context, name='n', parameters=[str(path)]).parameters == [('a', 1)]
    warning = (
        f"in the parameter file '{path}' '/n/b' and '/c' are not below any 'ros__parameters'"
        ' and so without effect'
    )
    assert capfd.readouterr().out.count(warning) == 1


def test_invalid_name(context: LaunchContext, capfd: pytest.CaptureFixture[str]) -> None:
    """An invalid name is an error that tells which node it is of."""
    with pytest.raises(ValueError, match='Invalid node name: .*\n.*a-b'):
        _request(context, name='a-b')
    assert "for 'package=p, plugin=P, name='a-b', namespace=None'" in capfd.readouterr().out


@pytest.mark.parametrize(
    'node_name, expected',
    [
        ('/n', ['any', 'root']),
        ('/talker', ['any', 'root', 'talker']),
        ('/robot/talker', ['any', 'talker', 'robot', 'below_robot', 'nested.deep']),
        ('/robot/left/talker', ['any', 'talker', 'below_robot']),
        ('/other', ['any', 'root', 'other']),
    ],
)
def test_wildcards_of_files(tmp_path: Path, node_name: str, expected: list[str]) -> None:
    """Keys may be names, nested namespaces, and wildcards for one part or any number."""
    path = tmp_path / 'p.yaml'
    path.write_text(FILE)
    found = dict(read_parameter_file(str(path)).parameters_of(node_name))
    assert list(found) == expected
    assert found.get('nested.deep', [1.0, 2.5]) == [1.0, 2.5]


@pytest.mark.parametrize(
    'pattern, is_meant',
    [('/**', True), ('/*', True), ('/**/n', False), ('/robot/*', False), ('', False)],
)
def test_node_without_a_name(context: LaunchContext, pattern: str, is_meant: bool) -> None:
    """For a node whose name the class decides on, only wildcards hold."""
    assert matches(pattern, _request(context).names.name_in_root) is is_meant


@pytest.mark.parametrize(
    'text, problem',
    [
        ('a: [', 'is not valid YAML'),
        ('- a', "below '/' there is \\['a'\\]"),
        ('a: {ros__parameters: 3}', "below '/a/ros__parameters' there is 3"),
        ('a: {ros__parameters: {p: [1, x]}}', 'inconsistent input for "p"'),
        ('a: {ros__parameters: {p: null}}', 'NoneType'),
    ],
)
def test_wrong_file(tmp_path: Path, text: str, problem: str) -> None:
    """The error of a file that is wrong names the file."""
    path = tmp_path / 'p.yaml'
    path.write_text(text)
    with pytest.raises((TypeError, ValueError), match=problem) as error:
        read_parameter_file(str(path)).parameters_of('/a')
    assert str(path) in str(error.value)


def test_numbers_in_files(tmp_path: Path) -> None:
    """Numbers are read as ROS reads them; what is in quotes stays a text."""
    path = tmp_path / 'p.yaml'
    path.write_text("/**: {ros__parameters: {a: 1e-3, b: '1e-3', c: 5, d: 1e3x, e: 0x10}}")
    found = dict(read_parameter_file(str(path)).parameters_of('/n'))
    assert found == {'a': 0.001, 'b': '1e-3', 'c': 5, 'd': '1e3x', 'e': 16}


def test_empty_file(tmp_path: Path) -> None:
    """A file, or a section of it, may be empty."""
    path = tmp_path / 'p.yaml'
    path.write_text('')
    assert read_parameter_file(str(path)).parameters_of('/n') == []
    path.write_text('/**: {ros__parameters: }')
    assert read_parameter_file(str(path)).parameters_of('/n') == []


def test_parameters_for_rclpy(context: LaunchContext) -> None:
    """The public helper returns rclpy parameters with their types."""
    parameter = pytest.importorskip('rclpy.parameter')
    elements = normalize_parameters([{'a': 1, 'b': [1.5]}, {'c': ParameterValue('x')}])
    evaluated = evaluate_parameters(context, elements)
    found = to_parameters_list(context, 'n', '/a', evaluated)
    assert [(each.name, each.type_, each.value) for each in found] == [
        ('a', parameter.Parameter.Type.INTEGER, 1),
        ('b', parameter.Parameter.Type.DOUBLE_ARRAY, [1.5]),
        ('c', parameter.Parameter.Type.STRING, 'x'),
    ]


def test_description() -> None:
    """The description keeps what it was given; its condition is asked for by a call."""
    node = ComposableNode(package='p', plugin='P', name='n')
    assert node.condition() is None and node.node_namespace is None
    assert [part.describe() for part in node.node_plugin] == ["'P'"]
    with pytest.raises(TypeError, match='node_name'):
        ComposableNode(package='p', plugin='P', node_name='n')  # type: ignore[call-arg]
