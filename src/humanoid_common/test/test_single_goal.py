# SPDX-License-Identifier: Apache-2.0
"""Check goals that have another action do a part of their work."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from action_msgs.msg import GoalStatus
from control_msgs.action import PointHead
from humanoid_common.client_goals import cancel_goal
from humanoid_common.single_goal import GoalAborted, GoalCanceled, RunningGoal, SingleGoal
from humanoid_common.testing.actions import ActionCaller
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
import pytest
from rclpy.action import ActionClient
from rclpy.node import Node

PATIENCE_S = 20.0


class Helper(Node):
    """Offers `look`, whose goals end when the test lets them."""

    def __init__(self, **options: Any) -> None:
        super().__init__('helper', **options)
        self.goals = SingleGoal(self, lambda: '')
        self.is_done = self.was_canceled = False
        self.goals.offer(PointHead, 'look', self._look, lambda request: self.reason)
        self.reason = ''

    async def _look(self, goal: RunningGoal) -> None:
        try:
            while not self.is_done:
                await goal.tick()
        except GoalCanceled:
            self.was_canceled = True
            raise


class Worker(Node):
    """Offers `work`, and lets the helper do it; a canceled goal counts to ten first."""

    def __init__(self, **options: Any) -> None:
        super().__init__('worker', **options)
        self._client = ActionClient(self, PointHead, 'look')
        self.goals = SingleGoal(self, lambda: '')
        self.ticks = 0
        self.trouble = GoalAborted('', '')
        self.goals.offer(PointHead, 'work', self._work)

    async def _work(self, goal: RunningGoal) -> None:
        try:
            answer = await goal.delegate(self._client, PointHead.Goal(), 'look', 'BODY_FAILED')
            assert answer.status == GoalStatus.STATUS_SUCCEEDED
        except GoalAborted as error:
            self.trouble = error
            raise
        except GoalCanceled:
            with goal.ending():
                for _ in range(10):
                    await goal.tick()
                    self.ticks += 1
            raise


class World:
    """A worker, its client, and a helper if there is one."""

    def __init__(self, ros: RosSandbox) -> None:
        """Start the worker."""
        self.ros = ros
        self.worker = ros.start(Worker)
        self.caller = ActionCaller(ros, PointHead, 'work')


@pytest.fixture(name='world')
def _world() -> Iterator[World]:
    """Give a worker in a domain of its own."""
    with ros_sandbox() as ros:
        world = World(ros)
        yield world
        world.caller.close()


def test_what_another_action_does_is_waited_for(world: World) -> None:
    """And its success is that of the goal."""
    helper = world.ros.start(Helper)
    handle = world.caller.send()
    end = handle.get_result_async()
    world.ros.wait_until(lambda: helper.goals.newest is not None, PATIENCE_S, 'a goal')
    assert not end.done()
    helper.is_done = True
    assert world.caller.end_of(handle).status == GoalStatus.STATUS_SUCCEEDED


def test_another_action_is_canceled_with_the_goal(world: World) -> None:
    """What leaves things in order still runs, and then the goal is canceled."""
    helper = world.ros.start(Helper)
    handle = world.caller.send()
    world.ros.wait_until(lambda: helper.goals.newest is not None, PATIENCE_S, 'a goal')
    world.caller.cancel(handle)
    assert world.caller.end_of(handle).status == GoalStatus.STATUS_CANCELED
    assert world.worker.ticks == 10
    world.ros.wait_until(lambda: helper.was_canceled, PATIENCE_S, 'the other cancel')


@pytest.mark.parametrize(
    ('is_there', 'sentence'),
    [(False, "No action server for 'look'"), (True, "'look' rejected a goal")],
)
def test_an_action_that_is_of_no_use_aborts_the_goal(
    world: World, is_there: bool, sentence: str
) -> None:
    """With the code that was asked for."""
    if is_there:
        world.ros.start(Helper).reason = 'It does not like it.'
    end = world.caller.end_of(world.caller.send())
    assert end.status == GoalStatus.STATUS_ABORTED
    assert world.worker.trouble.name == 'BODY_FAILED'
    assert sentence in str(world.worker.trouble)


def test_a_goal_whose_client_is_gone_cannot_be_canceled(world: World) -> None:
    """Work that was waiting ends like that when the garbage collector comes."""
    helper = world.ros.start(Helper)
    client = ActionClient(world.ros.observer(), PointHead, 'look')
    world.ros.wait_until(client.server_is_ready, PATIENCE_S, 'the helper')
    first, second = (client.send_goal_async(PointHead.Goal()) for _ in range(2))
    world.ros.wait_until(lambda: first.done() and second.done(), PATIENCE_S, 'two handles')
    cancel_goal(second)
    world.ros.wait_until(lambda: helper.was_canceled, PATIENCE_S, 'a goal that is canceled')
    client.destroy()
    after: list[Any] = []
    cancel_goal(first)
    first.add_done_callback(after.append)
    world.ros.wait_until(lambda: bool(after), PATIENCE_S, 'what follows the cancel')
