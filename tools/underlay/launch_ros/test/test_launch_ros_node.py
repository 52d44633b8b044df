# SPDX-License-Identifier: Apache-2.0
"""The command line of nodes."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
import subprocess
import sys
from typing import Any, Optional

from launch import LaunchContext
from launch.actions import GroupAction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node, PushRosNamespace, SetParameter, SetRemap
import pytest

Words = Callable[..., list[str]]
Run = Callable[..., Any]


def test_plain_program(words: Words) -> None:
    """There is always a part for ROS, even if it is empty."""
    assert words() == ['--ros-args']


def test_order_of_the_command_line(words: Words) -> None:
    """Own arguments come first, then names, then what holds for all nodes, then the rest."""
    from launch_ros.parameter_descriptions import Parameter

    found = words(
        PushRosNamespace('robot'),
        SetParameter('a', 1),
        SetRemap('x', 'y'),
        name='n',
        namespace='left',
        arguments=['-v', ['b', LaunchConfiguration('c', default=2)]],
        ros_arguments=['--log-level', 'debug'],
        remappings=[('in', 'out')],
        parameters=[Parameter('p', 2.0)],
    )
    assert found == [
        '-v',
        'b2',
        '--ros-args',
        '--log-level',
        'debug',
        '--ros-args',
        '-r',
        '__node:=n',
        '-r',
        '__ns:=/robot/left',
        '-p',
        'a:=1',
        '-p',
        'p:=2.0',
        '-r',
        'x:=y',
        '-r',
        'in:=out',
    ]


@pytest.mark.parametrize(
    'pushed, own, namespace',
    [
        (None, None, None),
        (None, 'a', '/a'),
        (None, '', '/'),
        (None, '/a/', '/a'),
        (None, '/', '/'),
        ('a', None, '/a'),
        ('a', 'b', '/a/b'),
        ('a', '/b', '/b'),
        ('/a/', 'b/', '/a/b'),
        ('', None, '/'),
        ('a', '', '/a'),
    ],
)
def test_namespace(
    words: Words,
    pushed: Optional[str],
    own: Optional[str],
    namespace: Optional[str],
) -> None:
    """The namespace is below the one that was pushed, unless it is absolute."""
    before = [] if pushed is None else [PushRosNamespace(pushed)]
    found = words(*before, namespace=own)
    assert found == ['--ros-args'] + ([] if namespace is None else ['-r', f'__ns:={namespace}'])


@pytest.mark.parametrize(
    'kwargs, text',
    [
        ({'name': 'a-b'}, "\n  'a-b'\n    ^\n"),
        ({'name': '1a'}, 'Invalid node name: node name must not start with a number'),
        ({'name': ''}, 'Invalid node name: node name must not be empty'),
        ({'namespace': 'a//b'}, 'Invalid namespace: namespace must not contain repeated'),
        ({'namespace': '/a/b c'}, "\n  '/a/b c'\n       ^\n"),
    ],
)
def test_invalid_names(run: Run, kwargs: Any, text: str) -> None:
    """An invalid name is an error that tells which node it is of."""
    status, out = run(Node(executable='/bin/true', **kwargs))
    assert status == 1 and text in out
    assert 'Error while expanding or validating node name or namespace for' in out
    assert f'package=None, executable=/bin/true, name={kwargs.get("name")}' in out


def test_names_before_and_after(context: LaunchContext) -> None:
    """The full name is known when the node is executed, with placeholders for what is missing."""
    node = Node(executable='/bin/true', name='n', remappings={('a', 'b')})
    with pytest.raises(RuntimeError, match='not known before'):
        _ = node.node_name
    node.prepare(context)
    assert node.node_name == '<node_namespace_unspecified>/n'
    assert not node.is_node_name_fully_specified()
    assert node.expanded_remapping_rules == [('a', 'b')]
    other = Node(executable='/bin/true', name='n', namespace='')
    other.prepare(context)
    assert other.node_name == '/n' and other.expanded_node_namespace == '/'
    assert (node.node_package, node.node_executable) == (None, '/bin/true')


def test_two_nodes_of_one_name(run: Run) -> None:
    """A second node with the same full name is reported before it is started."""

    def node() -> Node:
        return Node(executable='/bin/true', name='n', namespace='a', exec_name='it')

    status, out = run(node(), GroupAction([node()]), Node(executable='/bin/true', name='n'))
    assert status == 0
    assert out.count('there are now at least 2 nodes with the name /a/n created within') == 1
    assert out.index('at least 2 nodes') < out.index('process started')


@pytest.mark.parametrize(
    'kwargs, text',
    [
        ({'arguments': '-d x'}, r"must be a list, .* write arguments=\['-d', 'x'\]"),
        ({'remappings': [['a', 'b']]}, 'must be a tuple'),
        ({'remappings': [('a',)]}, 'must be a tuple'),
        ({'parameters': {'a': 1}}, 'put it in square brackets'),
        ({'parameters': [1]}, 'must be a dictionary, the path of a file, or a Parameter'),
        ({'node_name': 'x'}, 'node_name'),
    ],
)
def test_wrong_arguments(kwargs: Any, text: str) -> None:
    """What cannot work is refused when the node is created."""
    with pytest.raises(TypeError, match=text):
        Node(executable='/bin/true', **kwargs)


def test_node_of_a_package(run: Run, prefix: Callable[..., Any]) -> None:
    """The executable is looked up in the package; its label is its name."""
    prefix('pkg', 'talker')
    status, out = run(Node(package='pkg', executable='talker', arguments=['x'], output='screen'))
    assert status == 0 and '[talker-' in out and '] talker x --ros-args\n' in out


def test_importing_needs_no_ros() -> None:
    """A launch file can be read without loading rclpy, asyncio or YAML."""
    code = (
        'import sys, launch_ros, launch_ros.actions as a, launch_ros.substitutions as s;'
        'a.Node(package="p", executable="e", parameters=[{"a": 1}]); s.FindPackageShare("p");'
        'launch_ros.parameter_descriptions.ParameterValue("1", value_type=int);'
        'bad = {"asyncio", "yaml", "rclpy"} & set(sys.modules); sys.exit(str(bad) if bad else 0)'
    )
    result = subprocess.run([sys.executable, '-c', code], stderr=subprocess.PIPE, text=True)
    assert (result.returncode, result.stderr) == (0, '')


DEEP_PATHS = (
    'launch_ros.actions.composable_node_container.ComposableNodeContainer',
    'launch_ros.actions.load_composable_nodes.LoadComposableNodes',
    'launch_ros.actions.set_parameters_from_file.SetParametersFromFile',
    'launch_ros.events.lifecycle.change_state.ChangeState',
    'launch_ros.events.lifecycle.lifecycle_node_matchers.matches_node_name',
    'launch_ros.events.lifecycle.state_transition.StateTransition',
)


def test_deep_paths() -> None:
    """Public names are found in their packages and under their own modules."""
    import launch_ros.actions
    import launch_ros.descriptions
    import launch_ros.parameter_descriptions
    import launch_ros.substitutions
    import launch_ros.utilities

    for package in (launch_ros.actions, launch_ros.substitutions, launch_ros.utilities):
        for name in package.__all__:
            assert getattr(package, name) is not None
    from launch_ros.actions.push_ros_namespace import PushRosNamespace as deep

    assert deep is launch_ros.actions.PushROSNamespace
    for path in DEEP_PATHS:
        module, _, name = path.rpartition('.')
        assert hasattr(import_module(module), name), path
    assert launch_ros.descriptions.ParameterValue is (
        launch_ros.parameter_descriptions.ParameterValue
    )
