# SPDX-License-Identifier: Apache-2.0
"""The action server: ends of goals, newer goals, and the lifecycle of its node."""

from __future__ import annotations

from pathlib import Path
import sys
from typing import Any, cast

from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Duration
from lifecycle_msgs.msg import State
from nav2_msgs.action import ComputePathToPose
from nav2_util import ActionAborted, LifecycleNode, sleep
from nav2_util.actions import ActionServer
from nav2_util.timing import give_way
import pytest

sys.path.insert(0, str(Path(__file__).parent))  # tests are imported by their files
from navigation_servers import Client  # noqa: E402, I100

Result = ComputePathToPose.Result
SUCCEEDED, CANCELED = GoalStatus.STATUS_SUCCEEDED, GoalStatus.STATUS_CANCELED
ABORTED = GoalStatus.STATUS_ABORTED


class Worker(LifecycleNode):
    """Does with a goal what the name of its planner says."""

    def __init__(self, node_name: str = 'worker', **options: Any) -> None:
        super().__init__(node_name, **options)
        self.begun: list[str] = []
        self.takes_over = False

    def configure(self) -> None:
        """Offer the action."""
        self.server = self.offer_action(
            ComputePathToPose,
            'work',
            self.work,
            takes_over=self.takes_over,
            check_goal=lambda goal: None if goal.planner_id else 'it has no planner',
        )

    async def work(self, goal: Any) -> None:
        """Succeed, abort, fail, or go on until the goal ends."""
        todo = goal.planner_id
        self.begun.append(todo)
        if todo == 'abort':
            raise ActionAborted(Result.NO_VALID_PATH, 'There is a wall.')
        if todo == 'fail':
            raise KeyError('wall')
        while todo == 'deaf':
            await sleep(self, 0.01)
        while todo.startswith(('hang', 'busy')):
            self.server.check()
            if self.server.is_preempt_requested:
                todo = self.server.pending_goal().planner_id
                if todo == 'refused':
                    self.server.reject_pending(Result.GOAL_OCCUPIED, 'It is not free.')
                    todo = 'hang'
                    continue
                self.server.accept_pending()
                self.begun.append(f'taken over: {todo}')
            await (give_way(self) if todo == 'busy' else sleep(self, 0.01))
        self.server.result.planning_time = Duration(sec=7)


class Rig:
    """The node, a client, and goals."""

    def __init__(self, ros: Any, takes_over: bool = False, **parameters: Any) -> None:
        self.ros, self.node = ros, ros.make(Worker, parameters)
        self.node.takes_over = takes_over
        self.node.trigger_configure()
        self.node.trigger_activate()
        self.client = Client(ros, ros.node(), ComputePathToPose, 'work')

    def send(self, todo: str) -> Any:
        """Send a goal and wait until it is worked on, if it is not one that ends at once."""
        handle = self.client.send(planner_id=todo)
        if todo.startswith(('hang', 'busy', 'deaf')):
            self.ros.wait_until(lambda: any(todo in each for each in self.node.begun))
        return handle

    def end(self, handle: Any) -> tuple[int, int, str]:
        """Return status, error code and message of a goal."""
        status, result = self.client.wait(handle)
        return status, result.error_code, result.error_msg


@pytest.fixture
def rig(ros):
    """Work on goals one after the other."""
    made = Rig(ros)
    yield made
    made.client.close()


@pytest.fixture
def taking_over(ros):
    """Take over newer goals."""
    made = Rig(ros, takes_over=True)
    yield made
    made.client.close()


def test_success(rig):
    """A goal that is reached has what was filled in, and no error."""
    status, result = rig.client.wait(rig.send('done'))
    assert (status, result.error_code, result.error_msg) == (SUCCEEDED, 0, '')
    assert result.planning_time.sec == 7
    assert not rig.node.server.is_running and not rig.node.server.is_busy


def test_results_are_kept_for_a_while(ros):
    """Results are let go after the time that the parameter says, and goals go on."""
    rig = Rig(ros, action_server_result_timeout=0.3)
    kept = rig.node.server._server._result_futures
    for _ in range(3):
        assert rig.end(rig.send('done'))[0] == SUCCEEDED
        assert kept
        ros.wait_until(lambda: not kept, what='the end of the result')
    handles = [rig.send('abort') for _ in range(5)]
    assert [rig.end(handle)[0] for handle in handles] == [ABORTED] * 5
    ros.wait_until(lambda: not kept, what='the end of the results')
    assert rig.end(rig.send('done'))[0] == SUCCEEDED
    rig.client.close()


def test_abort(rig):
    """A goal that cannot be reached tells its code and why."""
    assert rig.end(rig.send('abort')) == (ABORTED, Result.NO_VALID_PATH, 'There is a wall.')


def test_error_in_the_work(rig, capfd):
    """A programming error ends the goal with a sentence; the next one is worked on."""
    status, code, message = rig.end(rig.send('fail'))
    assert (status, code) == (ABORTED, Result.UNKNOWN)
    assert message == "'work' failed: KeyError: 'wall'"
    assert 'Traceback' in capfd.readouterr().err
    assert rig.end(rig.send('done'))[0] == SUCCEEDED


def test_goal_that_is_refused(rig):
    """A goal that is not allowed is rejected at once."""
    assert not rig.send('').accepted


def test_cancel_in_the_middle(rig):
    """A goal that is canceled ends as that."""
    handle = rig.send('hang')
    handle.cancel_goal_async()
    assert rig.end(handle)[0] == CANCELED


def test_newer_goal(rig):
    """It ends the one that runs, and is worked on then."""
    old = rig.send('hang')
    new = rig.send('done')
    assert rig.end(old) == (ABORTED, Result.UNKNOWN, 'A newer goal took its place.')
    assert rig.end(new)[0] == SUCCEEDED
    assert rig.node.begun == ['hang', 'done']


def test_newer_goal_that_is_taken_over(taking_over):
    """The work goes on with the newer goal; the old one has lost its place."""
    old = taking_over.send('hang')
    new = taking_over.send('hang too')
    assert taking_over.end(old)[::2] == (ABORTED, 'A newer goal took its place.')
    assert taking_over.node.begun == ['hang', 'taken over: hang too']
    new.cancel_goal_async()
    assert taking_over.end(new)[0] == CANCELED


def test_newer_goal_that_cannot_be_reached(taking_over):
    """The old goal goes on."""
    old = taking_over.send('hang')
    refused = taking_over.send('refused')
    assert taking_over.end(refused) == (ABORTED, Result.GOAL_OCCUPIED, 'It is not free.')
    old.cancel_goal_async()
    assert taking_over.end(old)[0] == CANCELED


def test_two_newer_goals_at_once(rig):
    """Only the newest is worked on; all others have lost their place."""
    old = rig.send('hang')
    futures = [
        rig.client._client.send_goal_async(ComputePathToPose.Goal(planner_id=todo))
        for todo in ('hang b', 'done')
    ]
    rig.ros.wait_until(lambda: all(each.done() for each in futures))
    handles = [each.result() for each in futures]
    for each in handles:
        each.end = each.get_result_async()
    ends = [rig.end(each)[0] for each in (old, *handles)]
    assert ends == [ABORTED, ABORTED, SUCCEEDED]


def test_deactivation(rig):
    """It ends the goal that runs and the one that waits, and refuses others; then all is new."""
    running = rig.send('hang')
    rig.node.trigger_deactivate()
    assert rig.end(running) == (ABORTED, Result.UNKNOWN, "'work' was deactivated.")
    assert not rig.send('done').accepted
    rig.node.trigger_activate()
    assert rig.end(rig.send('done'))[0] == SUCCEEDED


def test_deactivation_while_a_goal_waits(taking_over):
    """The goal that waits is not begun by a node that is not active."""
    rig = taking_over
    server = rig.node.server
    rig.send('hang')
    server._takes_over = True
    newer = rig.client._client.send_goal_async(ComputePathToPose.Goal(planner_id='done'))
    rig.ros.wait_until(lambda: server.is_preempt_requested or newer.done())
    rig.node.trigger_deactivate()
    rig.ros.wait_until(lambda: not server.is_busy)
    assert 'done' not in rig.node.begun


def test_cleaned_up_and_configured_again(rig):
    """The same action serves a node that is configured anew, many times."""
    for _ in range(5):
        rig.node.trigger_deactivate()
        rig.node.trigger_cleanup()
        assert rig.node._state_machine.current_state[0] == State.PRIMARY_STATE_UNCONFIGURED
        assert not rig.send('done').accepted
        rig.node.trigger_configure()
        rig.node.trigger_activate()
        assert rig.end(rig.send('done'))[0] == SUCCEEDED


def test_client_that_goes_away(ros, rig):
    """A goal whose client has gone ends without harm; others are worked on."""
    gone = Client(ros, ros.node('gone'), ComputePathToPose, 'work')
    gone.send(planner_id='hang')
    gone.close()
    ros.nodes.pop().destroy_node()
    assert rig.end(rig.send('done'))[0] == SUCCEEDED


@pytest.mark.parametrize('todo', ['hang', 'busy', 'deaf'])
def test_node_that_is_destroyed_with_a_goal(ros, todo):
    """The executor goes on, and so do the other nodes, also if the goal does not end."""
    rig = Rig(ros)
    rig.send(todo)
    ros.wait_until(ros.executor.create_task(rig.node.wind_up).done)
    ros.nodes.remove(rig.node)
    ros.executor.remove_node(rig.node)
    ros.spin(0.05)
    rig.node.destroy_node()
    ros.spin(0.05)
    rig.client.close()
    assert ros.make(Worker, node_name='second').trigger_configure()


def test_winding_up_ends_goals(ros, rig):
    """Before a node goes away its clients are told."""
    running = rig.send('hang')
    end = ros.executor.create_task(rig.node.wind_up)
    ros.wait_until(end.done)
    assert running.end.done()
    assert rig.end(running) == (ABORTED, Result.UNKNOWN, "'work' was deactivated.")
    assert rig.node.state == 'inactive'


@pytest.mark.parametrize('step_ms', [1.0, 2.0, 4.0, 5.0, 10.0, 20.0, 100.0])
def test_no_step_of_a_simulated_clock_meets_the_result_timeout(
    monkeypatch: pytest.MonkeyPatch, step_ms: float
) -> None:
    """Whatever the parameter says: rclpy dispatches timers without end when one does."""
    timeouts_s: list[float] = []
    monkeypatch.setattr(
        'rclpy.action.ActionServer.__init__',
        lambda *_, result_timeout, **__: timeouts_s.append(result_timeout),
    )
    for result_timeout_s in (10.0, 2.5, 900.0):
        ActionServer(
            cast(Any, None),
            ComputePathToPose,
            'work',
            cast(Any, None),
            result_timeout_s=result_timeout_s,
        )
    steps = [1e3 * timeout_s / step_ms for timeout_s in timeouts_s]
    assert len(steps) == 3
    assert all(abs(count - round(count)) * step_ms > 0.05 for count in steps)
