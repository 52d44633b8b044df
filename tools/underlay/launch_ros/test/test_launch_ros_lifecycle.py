# SPDX-License-Identifier: Apache-2.0
"""Nodes with a life cycle, in a launch with real ones."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
import sys
import threading
from typing import Any

from launch.actions import EmitEvent, LogInfo, RegisterEventHandler, Shutdown, TimerAction
from launch.event_handlers import OnProcessStart
from launch.events import matches_action
from launch_ros.actions import LifecycleNode, LifecycleTransition
from launch_ros.event_handlers import OnStateTransition
from launch_ros.events import matches_node_name
from launch_ros.events.lifecycle import ChangeState
import pytest

pytest.importorskip('rclpy')
pytestmark = pytest.mark.usefixtures('own_domain')

Run = Callable[..., Any]
TALKER = str(Path(__file__).with_name('lifecycle_talker.py'))
CONFIGURE, ACTIVATE, DEACTIVATE = 1, 3, 4


def _talker(name: str = 'talker', fails: str = '', **kwargs: Any) -> LifecycleNode:
    return LifecycleNode(
        executable=sys.executable,
        arguments=[TALKER],
        name=name,
        namespace='robot',
        parameters=[{'fails': fails}],
        output='screen',
        **kwargs,
    )


def _ask(node: LifecycleNode, transition_id: int) -> EmitEvent:
    return EmitEvent(
        event=ChangeState(lifecycle_node_matcher=matches_action(node), transition_id=transition_id)
    )


def _when(node: LifecycleNode, goal: str, *entities: Any, **kwargs: Any) -> RegisterEventHandler:
    return RegisterEventHandler(
        OnStateTransition(
            target_lifecycle_node=node,
            goal_state=goal,
            entities=[LogInfo(msg=f'it is {goal}'), *entities],
            **kwargs,
        )
    )


def _ends(out: str) -> None:
    """Check that the launch's own node is gone, and that nothing went wrong."""
    assert 'Traceback' not in out
    assert 'launch_ros' not in [thread.name for thread in threading.enumerate()]


def test_chain(run: Run) -> None:
    """One transition follows the other, as the examples of ROS do it."""
    node = _talker()
    status, out = run(
        _when(node, 'inactive', _ask(node, ACTIVATE), start_state='configuring'),
        _when(node, 'active', _ask(node, DEACTIVATE), start_state='activating'),
        _when(node, 'inactive', Shutdown(reason='done'), start_state='deactivating'),
        node,
        RegisterEventHandler(OnProcessStart(target_action=node, on_start=[_ask(node, CONFIGURE)])),
    )
    assert status == 0
    lines = [line.split(': ')[-1] for line in out.splitlines() if 'it is' in line]
    assert lines == ['it is inactive', 'it is active', 'it is inactive']
    _ends(out)


def test_requests_come_one_after_the_other(run: Run) -> None:
    """Two transitions asked for at once are made in order; a name finds its node."""
    node = _talker()

    def ask(transition_id: int) -> EmitEvent:
        matcher = matches_node_name('/robot/talker')
        return EmitEvent(
            event=ChangeState(lifecycle_node_matcher=matcher, transition_id=transition_id)
        )

    once = _when(node, 'active', Shutdown(), handle_once=True)
    status, out = run(node, ask(CONFIGURE), ask(ACTIVATE), once)
    assert (status, out.count('it is active')) == (0, 1)
    assert 'Failed' not in out


def test_transition_action(run: Run) -> None:
    """An action takes several nodes through the same transitions."""
    first, second = _talker('first'), _talker('second')
    both: list[Any] = []

    def note(event: Any, context: Any) -> Any:
        both.append(event.action.node_name)
        return Shutdown() if len(both) == 2 else None

    class Noting(OnStateTransition):
        def handle(self, event: Any, context: Any) -> Any:
            return note(event, context)

    status, out = run(
        first,
        second,
        RegisterEventHandler(Noting(goal_state='active', entities=[])),
        LifecycleTransition(
            lifecycle_node_names=['/robot/first', 'robot/second'],
            transition_ids=[CONFIGURE, str(ACTIVATE)],
        ),
    )
    assert status == 0 and sorted(both) == ['/robot/first', '/robot/second']
    _ends(out)


def test_transition_that_fails(run: Run) -> None:
    """A transition that fails is reported, and ends the chain; the launch is not a failure."""
    node = _talker(fails='activate')
    status, out = run(
        node,
        _when(node, 'inactive', Shutdown(), start_state='activating'),
        LifecycleTransition(
            lifecycle_node_names=['robot/talker'],
            transition_ids=[CONFIGURE, ACTIVATE, DEACTIVATE],
        ),
    )
    assert status == 0
    assert "'robot/talker' went to the state 'inactive' instead of 'active'" in out
    assert 'TRANSITION_DEACTIVATE' not in out


def test_failure_is_reported(run: Run) -> None:
    """The line names the transition and the node."""
    node = _talker(fails='configure')
    status, out = run(
        node,
        _ask(node, CONFIGURE),
        _when(node, 'unconfigured', TimerAction(period=1.0, actions=[Shutdown()])),
    )
    assert status == 0
    assert (
        '[ERROR] [launch_ros.actions.lifecycle_node]: '
        "Failed to make transition 'TRANSITION_CONFIGURE' for LifecycleNode '/robot/talker'\n"
    ) in out


def test_process_that_dies(run: Run) -> None:
    """Nobody waits for the answer of a process that has ended."""
    node = _talker(fails='die')
    status, out = run(node, _ask(node, CONFIGURE))
    assert status == 0
    assert "Failed to make transition 'TRANSITION_CONFIGURE'" in out
    assert "the process that offers '/robot/talker/change_state' has ended" in out
    _ends(out)


def test_shutdown_while_waiting(run: Run) -> None:
    """A node that never offers the service does not delay the end."""
    node = LifecycleNode(executable='sh', arguments=['-c', 'sleep 1000'], name='n', namespace='')
    status, out = run(
        node, _ask(node, CONFIGURE), TimerAction(period=0.5, actions=[Shutdown(reason='enough')])
    )
    assert status == 0
    assert (
        '[WARNING] [launch_ros.actions.lifecycle_node]: '
        "Abandoning wait for the '/n/change_state' service, due to shutdown.\n"
    ) in out
    _ends(out)


def test_request_during_the_shutdown(run: Run) -> None:
    """What is asked of a node while the launch ends is not done, and said so."""
    from launch.event_handlers import OnShutdown

    node = LifecycleNode(executable='sh', arguments=['-c', 'sleep 1000'], name='n', namespace='')
    status, out = run(
        node,
        RegisterEventHandler(OnShutdown(on_shutdown=[_ask(node, 5)])),
        TimerAction(period=0.1, actions=[Shutdown()]),
    )
    assert status == 0 and "'/n/change_state' service, due to shutdown." in out
