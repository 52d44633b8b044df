# SPDX-License-Identifier: Apache-2.0
"""Cases of section 3.14: composition, life cycles, and the launch's own node."""

from __future__ import annotations

import json
from pathlib import Path
import sys
from typing import Any

import pytest

pytest.importorskip('rclpy')
pytest.importorskip('composition_interfaces')
pytestmark = pytest.mark.usefixtures('own_domain')

FAKE = str(Path(__file__).parents[1] / 'fake_container.py')
TALKER = str(Path(__file__).parents[1] / 'lifecycle_talker.py')
HELPERS = f"""
import launch.events
from launch.events import matches_action
from launch_ros.descriptions import ComposableNode, ParameterFile
from launch_ros.event_handlers import OnStateTransition
from launch_ros.events import matches_node_name
from launch_ros.events.lifecycle import ChangeState
from lifecycle_msgs.msg import Transition


def container(*nodes, name='c', **kwargs):
    return ComposableNodeContainer(
        package='', executable='', name=name, namespace='box', output='screen',
        composable_node_descriptions=list(nodes), **kwargs)


def node(name=None, plugin='Good', **kwargs):
    return ComposableNode(package='pkg', plugin=plugin, name=name, **kwargs)


def end_with(action):
    return RegisterEventHandler(OnExecutionComplete(
        target_action=action, on_completion=[Shutdown()]))


def talker(name='talker', fails='', **kwargs):
    return LifecycleNode(
        executable={sys.executable!r}, arguments=[{TALKER!r}], name=name, namespace='robot',
        parameters=[{{'fails': fails}}], output='screen', **kwargs)


def ask(it, transition_id):
    return EmitEvent(event=ChangeState(
        lifecycle_node_matcher=matches_action(it), transition_id=transition_id))


def when(it, goal, *entities, **kwargs):
    return RegisterEventHandler(OnStateTransition(
        target_lifecycle_node=it, goal_state=goal,
        entities=[LogInfo(msg='it is ' + goal), *entities], **kwargs))

""".replace("package='', executable='',", f'executable={sys.executable!r}, arguments=[{FAKE!r}],')


def _asked(out: Any) -> list[dict[str, Any]]:
    """Return what the container was asked for."""
    return [json.loads('{' + line.partition('{')[2]) for line in out.lines if '] {"' in line]


def test_request(launch: Any) -> None:
    """3.14 A container is asked for what is known at the visit: names, remaps, parameters."""
    out = launch(
        HELPERS
        + """
it = container()
load = LoadComposableNodes(target_container=it, composable_node_descriptions=[
    node(['tal', 'ker'], namespace='left', remappings=[('in', 'out')],
         parameters=['p.yaml', {'flag': True, 'n': 5, 'text': '5',
                                 'typed': LaunchConfiguration('x')}],
         extra_arguments=[{'use_intra_process_comms': True}])])
---
end_with(load),
SetLaunchConfiguration('x', '[1, 2]'),
it,
GroupAction([
    PushRosNamespace('robot'),
    SetParameter('all', 2.5),
    SetRemap('x', 'y'),
    load,
]),
SetLaunchConfiguration('x', 'late'),
""",
        files={'p.yaml': '/**:\n  ros__parameters: {any: 1}\n/no:\n  ros__parameters: {no: 1}\n'},
    )
    assert out.status == 0
    assert _asked(out) == [
        {
            'container': '/box/c',
            'package': 'pkg',
            'plugin': 'Good',
            'name': 'talker',
            'namespace': '/robot/left',
            'remaps': ['x:=y', 'in:=out'],
            'parameters': [
                ['all', 2.5],
                ['any', 1],
                ['flag', True],
                ['n', 5],
                ['text', '5'],
                ['typed', [1, 2]],
            ],
            'extra': [['use_intra_process_comms', True]],
        }
    ]
    assert (
        "[INFO] [launch_ros.actions.load_composable_nodes]: Loaded node '/robot/left/talker' in "
        "container '/box/c'"
    ) in out.lines


def test_nodes_of_a_container(launch: Any) -> None:
    """3.14 They load in order, outside its namespace; a failure and a duplicate are told."""
    out = launch(
        HELPERS
        + """
nodes = [node('b'), node('out', condition=IfCondition('0')), node(), node('bad', plugin='Bad'),
         node('b'), node('end', plugin='Die')]
---
container(*nodes),
"""
    )
    assert out.status == 0
    asked = [(each['name'], each['namespace']) for each in _asked(out)]
    assert asked == [('b', ''), ('', ''), ('bad', ''), ('b', ''), ('end', '')]
    assert (
        "[ERROR] [launch_ros.actions.load_composable_nodes]: Failed to load node 'bad' of type "
        "'Bad' in container '/box/c': no such class"
    ) in out.lines
    assert [line for line in out.lines if 'there are now at least' in line] == [
        '[WARNING] [/box/c]: there are now at least 2 nodes with the name /b created within this '
        'launch context'
    ]


def test_two_actions_at_once(launch: Any, tmp_path: Path) -> None:
    """3.14 Two actions load at once: each container answers when the other is asked as well."""
    (tmp_path / 'meet').mkdir()
    out = launch(
        HELPERS
        + """
ends = []


def load(name):
    action = LoadComposableNodes(target_container=['/box/', name], composable_node_descriptions=[
        ComposableNode(package='meet', plugin='Meet', name=name)])
    return [RegisterEventHandler(OnExecutionComplete(
        target_action=action,
        on_completion=lambda event, context: ends.append(1) or ends[1:] and Shutdown() or None)),
        action]
---
container(name='first'), container(name='second'), *load('first'), *load('second'),
"""
    )
    assert out.status == 0
    for name in ('first', 'second'):
        assert f"Loaded node '/{name}' in container '/box/{name}'" in out.text


def test_shutdown_while_waiting(launch: Any) -> None:
    """3.14 The launch waits for a container as long as it takes, but not in a shutdown."""
    out = launch(
        HELPERS
        + """
---
LoadComposableNodes(composable_node_descriptions=[node('n')], target_container='/gone'),
TimerAction(period=0.5, actions=[Shutdown()]),
"""
    )
    assert out.status == 0
    assert (
        '[WARNING] [launch_ros.actions.load_composable_nodes]: Abandoning wait for the '
        "'/gone/_container/load_node' service, due to shutdown."
    ) in out.text.replace('service…', 'service')


@pytest.mark.parametrize(
    'action',
    [
        "ComposableNodeContainer(package='p', executable='e', name='n')",
        "ComposableNodeContainer(package='p', executable='e', namespace='n')",
        "LifecycleNode(package='p', executable='e', name='n')",
        'LoadComposableNodes(composable_node_descriptions=[], target_container=5)',
    ],
)
def test_what_must_be_given(action: str, launch: Any) -> None:
    """3.14 A container and a lifecycle node need a name and a namespace; a target is either."""
    out = launch(f'{action},')
    assert (out.status, ' - TypeError: ' in out.error) == (1, True)


def test_lifecycle(launch: Any) -> None:
    """3.14 A lifecycle node tells its transitions and is asked for the next by events."""
    out = launch(
        HELPERS
        + """
it = talker()
---
when(it, 'inactive', ask(it, Transition.TRANSITION_ACTIVATE), start_state='configuring'),
when(it, 'active', EmitEvent(event=ChangeState(
    lifecycle_node_matcher=matches_node_name('/robot/talker'),
    transition_id=Transition.TRANSITION_DEACTIVATE)), handle_once=True),
when(it, 'inactive', Shutdown(), start_state='deactivating'),
it,
RegisterEventHandler(OnProcessStart(target_action=it, on_start=[
    ask(it, Transition.TRANSITION_CONFIGURE)])),
"""
    )
    assert out.status == 0
    assert out.said == ['it is inactive', 'it is active', 'it is inactive']


def test_transition_that_fails(launch: Any) -> None:
    """3.14 A transition that fails is an error in the log, and the status stays 0."""
    out = launch(
        HELPERS
        + """
it = talker(fails='configure')
---
when(it, 'unconfigured', TimerAction(period=0.5, actions=[Shutdown()])),
it,
ask(it, Transition.TRANSITION_CONFIGURE),
"""
    )
    assert out.status == 0
    failed = "Failed to make transition 'TRANSITION_CONFIGURE' for LifecycleNode '/robot/talker'"
    assert any(failed in line for line in out.lines if line.startswith('[ERROR]'))


def test_chain_of_transitions(launch: Any) -> None:
    """3.14 One action takes nodes through transitions one after the other."""
    out = launch(
        HELPERS
        + """
it = talker()
---
when(it, 'active', Shutdown()),
it,
LifecycleTransition(lifecycle_node_names=['/robot/talker'], transition_ids=[
    Transition.TRANSITION_CONFIGURE, Transition.TRANSITION_ACTIVATE]),
"""
    )
    assert (out.status, out.said) == (0, ['it is active'])


def test_invalid_transition(launch: Any) -> None:
    """3.14 A transition that does not exist is a ValueError."""
    out = launch(HELPERS + "it = talker()\nask(it, 200)\n---\nLogInfo(msg='never'),\n")
    assert (out.status, ' - ValueError: ' in out.error) == (1, True)


def test_timer_on_ros_time_and_the_own_node(launch: Any) -> None:
    """3.14 A timer follows ROS time; the launch's own node has its process id in its name."""
    out = launch(
        """
        from launch_ros.ros_adapters import get_ros_node
        ---
        ROSTimer(period=0.2, actions=[LogInfo(msg='timer')]),
        OpaqueFunction(function=lambda context: print(get_ros_node(context).get_name())),
        """
    )
    assert (out.status, out.said) == (0, ['timer'])
    assert f'launch_ros_{launch.started[-1].process.pid}' in out.lines


def test_deprecated_matcher(launch: Any) -> None:
    """3.14 The old place of matches_node_name works and warns."""
    out = launch.script(
        """
        import warnings
        warnings.simplefilter('always')
        from launch_ros.events.lifecycle import matches_node_name
        print(callable(matches_node_name('/a')))
        """
    )
    assert out.stdout == 'True\n'
    assert 'Warning' in out.err and 'Traceback' not in out.err


def test_plain_launch_needs_no_ros(launch: Any) -> None:
    """3.14 The launch's own node is made when it is needed, and rclpy not imported before."""
    out = launch(
        """
        import sys
        ---
        Node(package='stub', executable='rec'),
        OpaqueFunction(function=lambda context: print('rclpy' in sys.modules, flush=True)),
        """
    )
    assert 'False' in out.lines
