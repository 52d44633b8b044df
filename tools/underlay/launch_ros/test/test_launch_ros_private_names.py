# SPDX-License-Identifier: Apache-2.0
"""Private names of ROS 2 Jazzy that public launch files, and tests of them, make use of."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from launch import LaunchContext, LaunchDescription, LaunchService
from launch.actions import (
    DeclareLaunchArgument,
    ExecuteProcess,
    GroupAction,
    IncludeLaunchDescription,
    LogInfo,
    OpaqueFunction,
    TimerAction,
)
from launch.conditions import IfCondition, UnlessCondition
from launch.event_handlers import OnProcessExit
from launch.substitutions import LaunchConfiguration, TextSubstitution
from launch.utilities import perform_substitutions
from launch_ros.actions import ComposableNodeContainer, LoadComposableNodes, Node
from launch_ros.descriptions import ComposableNode
from launch_ros.utilities import evaluate_parameters
import pytest


def react(*_: Any) -> None:
    """Do nothing."""


LOG = LogInfo(msg='x')
PROCESS = ExecuteProcess(cmd=['x'], respawn=True, respawn_delay=1.0, output='screen', on_exit=LOG)
NODE = Node(
    package='arm',
    executable='sweep',
    name='left',
    namespace='robot',
    arguments=['-x', 'y'],
    ros_arguments=['--log-level', 'debug'],
    condition=IfCondition('true'),
)
PART = ComposableNode(package='p', plugin='P', name='n')
LOAD = LoadComposableNodes(composable_node_descriptions=[PART], target_container='/c')
CONTAINER = ComposableNodeContainer(
    name='c', namespace='', executable='x', composable_node_descriptions=[PART]
)
INCLUDE = IncludeLaunchDescription('/a.py', launch_arguments={'b': 'False'}.items())
GROUP = GroupAction([LOG], forwarding=False)
TIMER = TimerAction(period=2.0, actions=[LOG])
HANDLER = OnProcessExit(target_action=PROCESS, on_exit=[LOG])
CALLING = OnProcessExit(on_exit=react)
SERVICE = LaunchService()
VALUE = LaunchConfiguration('v')
FUNCTION = OpaqueFunction(function=react, args=[1])


@pytest.mark.parametrize(
    ('owner', 'name', 'expected'),
    [
        (NODE, '_Node__package', 'arm'),
        (NODE, '_Node__node_executable', 'sweep'),
        (NODE, '_Node__node_name', 'left'),
        (NODE, '_Node__node_namespace', 'robot'),
        (NODE, '_Node__arguments', ['-x', 'y']),
        (NODE, '_Node__ros_arguments', ['--log-level', 'debug']),
        (NODE, '_Action__condition', NODE.condition),
        (PROCESS, '_ExecuteLocal__respawn', True),
        (PROCESS, '_ExecuteLocal__respawn_delay', 1.0),
        (PROCESS, '_ExecuteLocal__shell', False),
        (PROCESS, '_ExecuteLocal__on_exit', [LOG]),
        (PROCESS, '_ExecuteLocal__process_description', PROCESS.process_description),
        (LOAD, '_LoadComposableNodes__composable_node_descriptions', [PART]),
        (CONTAINER, '_ComposableNodeContainer__composable_node_descriptions', [PART]),
        (INCLUDE, '_IncludeLaunchDescription__launch_arguments', (('b', 'False'),)),
        (
            INCLUDE,
            '_IncludeLaunchDescription__launch_description_source',
            INCLUDE.launch_description_source,
        ),
        (GROUP, '_GroupAction__actions', [LOG]),
        (GROUP, '_GroupAction__scoped', True),
        (GROUP, '_GroupAction__forwarding', False),
        (TIMER, '_TimerAction__period', 2.0),
        (TIMER, '_TimerAction__actions', [LOG]),
        (HANDLER, '_OnActionEventBase__action_matcher', PROCESS),
        (HANDLER, '_OnActionEventBase__on_event', [LOG]),
        (HANDLER, '_OnActionEventBase__actions_on_event', [LOG]),
        (CALLING, '_OnActionEventBase__on_event', react),
        (FUNCTION, '_OpaqueFunction__function', react),
        (FUNCTION, '_OpaqueFunction__args', (1,)),
        (DeclareLaunchArgument('a'), '_DeclareLaunchArgument__name', 'a'),
        (LaunchDescription([LOG]), '_LaunchDescription__entities', [LOG]),
        (VALUE, '_LaunchConfiguration__variable_name', VALUE.variable_name),
        (TextSubstitution(text='t'), '_TextSubstitution__text', 't'),
        (SERVICE, '_LaunchService__context', SERVICE.context),
    ],
)
def test_values(owner: Any, name: str, expected: Any) -> None:
    """What is there under the name is what was given."""
    assert getattr(owner, name) == expected


@pytest.mark.parametrize(
    ('owner', 'name', 'text'),
    [
        (INCLUDE.launch_description_source, '_LaunchDescriptionSource__location', '/a.py'),
        (
            DeclareLaunchArgument('a', default_value='d'),
            '_DeclareLaunchArgument__default_value',
            'd',
        ),
        (PROCESS, '_ExecuteLocal__output', 'screen'),
        (IfCondition('true'), '_IfCondition__predicate_expression', 'true'),
        (PART, '_ComposableNode__package', 'p'),
        (PART, '_ComposableNode__node_plugin', 'P'),
        (PART, '_ComposableNode__node_name', 'n'),
        (LOAD, '_LoadComposableNodes__target_container', '/c'),
    ],
)
def test_texts(context: LaunchContext, owner: Any, name: str, text: str) -> None:
    """What is there under the name is made of substitutions."""
    assert perform_substitutions(context, getattr(owner, name)) == text


@pytest.mark.parametrize(
    ('condition', 'expected'), [(IfCondition('1'), True), (UnlessCondition('1'), False)]
)
def test_predicate(context: LaunchContext, condition: Any, expected: bool) -> None:
    """A condition can be asked without an action."""
    assert condition._predicate_func(context) is expected


def test_context(context: LaunchContext) -> None:
    """Scopes can be opened and closed by hand."""
    context._push_launch_configurations()
    context._push_environment()
    context._LaunchContext__launch_configurations.update({'a': 'b'})  # type: ignore[attr-defined]
    assert context.launch_configurations['a'] == 'b'
    context._pop_environment()
    context._pop_launch_configurations()
    assert 'a' not in context.launch_configurations


def test_included_file() -> None:
    """An include knows its file."""
    assert INCLUDE._get_launch_file() == '/a.py'


def test_expanded_node(context: LaunchContext, tmp_path: Path) -> None:
    """A node can be told to find out what it will be given, without being executed."""
    path = tmp_path / 'p.yaml'
    path.touch()
    node: Any = Node(
        executable='x',
        name='left',
        namespace='robot',
        parameters=[str(path), {'a': 1}],
        remappings=[('b', 'c')],
    )
    node._perform_substitutions(context)
    assert (node.node_name, node.expanded_node_namespace) == ('/robot/left', '/robot')
    (first, is_file), (second, _) = node._Node__expanded_parameter_arguments
    assert (first, is_file) == (str(path), True) and "'a': 1" in Path(second).read_text()
    assert node._Node__expanded_remappings == [('b', 'c')]
    assert evaluate_parameters(context, node._Node__parameters)[1] == {'a': 1}
    ((source, target),) = node._Node__remappings
    assert perform_substitutions(context, source) + perform_substitutions(context, target) == 'bc'


def test_output_that_is_changed_later(run: Any) -> None:
    """Where the output goes counts when the process is executed."""
    process: Any = ExecuteProcess(cmd=['sh', '-c', 'echo shown'], output='log')
    process._ExecuteLocal__output = [TextSubstitution(text='screen')]
    status, text = run(process)
    assert status == 0 and '] shown\n' in text
