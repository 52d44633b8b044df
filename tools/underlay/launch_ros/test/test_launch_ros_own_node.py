# SPDX-License-Identifier: Apache-2.0
"""The launch's own ROS node, and what works with it."""

from __future__ import annotations

from collections.abc import Callable
import os
import subprocess
import sys
import threading
from typing import Any

from launch import LaunchContext
from launch.actions import (
    EmitEvent,
    ExecuteProcess,
    GroupAction,
    LogInfo,
    OpaqueFunction,
    SetLaunchConfiguration,
    Shutdown,
    TimerAction,
)
from launch.events import Shutdown as ShutdownEvent
from launch.substitutions import LaunchConfiguration, TextSubstitution
from launch_ros.actions import ROSTimer, SetUseSimTime
from launch_ros.ros_adapters import get_ros_adapter, get_ros_node
import pytest

pytest.importorskip('rclpy')
pytestmark = pytest.mark.usefixtures('own_domain')

Run = Callable[..., Any]


def _threads() -> list[str]:
    return [thread.name for thread in threading.enumerate()]


def test_node(run: Run) -> None:
    """There is one node, with a thread while the launch runs, and none afterwards."""
    seen: list[Any] = []

    def look(context: LaunchContext) -> None:
        node = get_ros_node(context)
        seen.append((node.get_name(), node is get_ros_adapter(context).ros_node))
        seen.append((_threads().count('launch_ros'), get_ros_adapter(context).ros_context.ok()))
        seen.append(get_ros_adapter(context))

    status, _ = run(OpaqueFunction(function=look), OpaqueFunction(function=look))
    assert status == 0
    assert seen[0] == (f'launch_ros_{os.getpid()}', True) and seen[1] == (1, True)
    assert seen[2] is seen[5]
    assert 'launch_ros' not in _threads()
    assert not seen[2].is_running and not seen[2].ros_context.ok()


def test_callbacks(run: Run) -> None:
    """Callbacks run beside the launch; one that fails is reported and does no further harm."""

    def use(context: LaunchContext) -> None:
        node = get_ros_node(context)

        def fail() -> None:
            node.destroy_timer(timers[0])
            timers.append(node.create_timer(0.01, go_on))
            raise RuntimeError('a mistake')

        def go_on() -> None:
            context.emit_event_sync(ShutdownEvent(reason='called back'))

        timers = [node.create_timer(0.01, fail)]

    forever = ExecuteProcess(cmd=['sleep', '1000'])
    status, out = run(forever, OpaqueFunction(function=use))
    assert status == 0
    assert "a callback of the launch's own ROS node failed: RuntimeError: a mistake" in out


def test_outside_of_a_launch(context: LaunchContext) -> None:
    """The node can be used without a running launch, and is ended by hand."""
    adapter = get_ros_adapter(context)
    assert get_ros_node(context).get_name().startswith('launch_ros_')
    adapter.shutdown()
    adapter.shutdown()
    assert 'launch_ros' not in _threads()
    again = get_ros_adapter(context)
    assert again is not adapter and again.ros_context.ok()
    again.shutdown()


def test_not_while_the_launch_ends(context: LaunchContext) -> None:
    """A launch that ends makes no new node."""
    context.run.is_shutdown = True
    with pytest.raises(RuntimeError, match='the launch is ending'):
        get_ros_node(context)


def test_interpreter_ends_cleanly() -> None:
    """A node that nobody has ended does not keep the interpreter from ending."""
    code = (
        'from launch import LaunchContext; from launch_ros.ros_adapters import get_ros_node;'
        'get_ros_node(LaunchContext())'
    )
    result = subprocess.run([sys.executable, '-c', code], capture_output=True, timeout=60)
    assert (result.returncode, result.stdout, result.stderr) == (0, b'', b'')


def test_timer(run: Run) -> None:
    """A timer visits its actions once, in the scope in which it was started."""
    scope = GroupAction(
        [
            SetLaunchConfiguration('x', 'inner'),
            ROSTimer(period=0.05, actions=[LogInfo(msg=['x is ', LaunchConfiguration('x')])]),
        ]
    )
    status, out = run(scope)
    assert status == 0 and out.count('x is inner') == 1


@pytest.mark.parametrize('period', [TextSubstitution(text='0.0'), 0.0])
def test_timer_without_a_period(run: Run, period: Any) -> None:
    """A period may be nothing at all."""
    status, out = run(ROSTimer(period=period, actions=[LogInfo(msg='the time has come')]))
    assert status == 0 and out.count('the time has come') == 1


def test_timer_that_is_not_over(run: Run) -> None:
    """The end of the launch ends its timers, whatever they say."""
    status, out = run(
        ROSTimer(
            period=1000.0, actions=[LogInfo(msg='the time has come')], cancel_on_shutdown=False
        ),
        TimerAction(period=0.1, actions=[Shutdown()]),
    )
    assert status == 0 and 'the time has come' not in out


def test_timer_refuses_whole_numbers() -> None:
    """The period is a float, as that of other timers."""
    with pytest.raises(TypeError, match=r'write 1\.0 instead'):
        ROSTimer(period=1, actions=[])


@pytest.mark.parametrize('is_set_first', [True, False])
def test_time_of_a_simulation(run: Run, is_set_first: bool) -> None:
    """A timer follows /clock if the launch is told to, before or after its node is made."""

    def tick(context: LaunchContext) -> None:
        from rclpy.clock import Clock as SteadyClock
        from rclpy.clock import ClockType
        from rosgraph_msgs.msg import Clock

        node = get_ros_node(context)
        publisher = node.create_publisher(Clock, '/clock', 1)
        seconds = [0]

        def publish() -> None:
            clock = Clock()
            clock.clock.sec = seconds[0]
            seconds[0] += 100
            publisher.publish(clock)

        steady = SteadyClock(clock_type=ClockType.STEADY_TIME)
        node.create_timer(0.02, publish, clock=steady)

    timer = ROSTimer(
        period=1000.0, actions=[LogInfo(msg='the time has come'), EmitEvent(event=_end())]
    )
    choice = SetUseSimTime(True)
    first, second = (
        [choice, OpaqueFunction(function=tick)],
        [OpaqueFunction(function=tick), choice],
    )
    forever = ExecuteProcess(cmd=['sleep', '1000'])
    status, out = run(*(first if is_set_first else second), timer, forever)
    assert status == 0 and out.count('the time has come') == 1


def _end() -> ShutdownEvent:
    return ShutdownEvent(reason='done')


def test_importing_the_actions_needs_no_ros() -> None:
    """Describing such actions loads neither rclpy nor messages nor asyncio."""
    code = (
        'import sys, launch_ros.actions as a, launch_ros.descriptions as d;'
        'from launch_ros.event_handlers import OnStateTransition;'
        'from launch_ros.events.lifecycle import ChangeState;'
        'n = a.LifecycleNode(package="p", executable="e", name="n", namespace="");'
        'OnStateTransition(target_lifecycle_node=n, goal_state="active", entities=[]);'
        'ChangeState(lifecycle_node_matcher=lambda n: True, transition_id=1);'
        'c = a.ComposableNodeContainer(package="p", executable="e", name="n", namespace="",'
        'composable_node_descriptions=[d.ComposableNode(package="p", plugin="P")]);'
        'a.LoadComposableNodes(composable_node_descriptions=[], target_container=c);'
        'a.ROSTimer(period=1.0, actions=[]);'
        'a.LifecycleTransition(lifecycle_node_names=["n"], transition_ids=[1]);'
        'import launch_ros.ros_adapters;'
        'bad = {"asyncio", "rclpy", "lifecycle_msgs", "yaml"} & set(sys.modules);'
        'sys.exit(str(bad) if bad else 0)'
    )
    result = subprocess.run([sys.executable, '-c', code], stderr=subprocess.PIPE, text=True)
    assert (result.returncode, result.stderr) == (0, '')
