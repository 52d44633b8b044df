# SPDX-License-Identifier: Apache-2.0
"""Take a can from a table in the simulator, put it down, and hand it over."""

from __future__ import annotations

from collections.abc import Iterator
import math

from action_msgs.msg import GoalStatus
from humanoid_interfaces.action import Drop, HandOver, Pick, Place
from humanoid_manipulation.manipulator import Manipulator
from humanoid_manipulation.testing import PATIENCE_S, table_world, TableWorld
import pytest

pytestmark = pytest.mark.timeout(400)


@pytest.fixture(name='running', scope='module')
def _running(
    tmp_path_factory: pytest.TempPathFactory,
) -> Iterator[tuple[TableWorld, Manipulator]]:
    """Give a robot before a table, and the node that moves its arms."""
    folder = tmp_path_factory.mktemp('manipulation')
    with table_world(folder, 1.5, Manipulator) as (world, manipulator):
        assert manipulator is not None
        yield world, manipulator


@pytest.fixture(name='world')
def _world(running: tuple[TableWorld, Manipulator]) -> TableWorld:
    """Give the robot before the table."""
    return running[0]


def test_what_is_not_there_is_not_taken(world: TableWorld) -> None:
    """Each reason has its code."""
    end = world.act('pick', object='unicorn')
    assert end.status == GoalStatus.STATUS_ABORTED
    assert end.result.error_code == Pick.Result.NOT_SEEN
    assert "'unicorn'" in end.result.error_msg
    for name, code in (
        ('place', Place.Result.EMPTY_HAND),
        ('hand_over', HandOver.Result.EMPTY_HAND),
        ('drop', Drop.Result.EMPTY_HAND),
    ):
        assert world.act(name).result.error_code == code


def test_a_canceled_goal_leaves_the_can_and_the_robot_in_order(world: TableWorld) -> None:
    """The hand comes back, and the robot stands upright."""
    world.remember()
    world.robot.wait(0.5)
    before = world.can_m
    goal = world.start('pick', object='can')
    world.ros.wait_until(
        lambda: 'reaching' in world.states('pick'), PATIENCE_S, 'a hand on its way'
    )
    world.robot.wait(0.7)
    goal.cancel_goal_async()
    assert world.end_of('pick', goal).status == GoalStatus.STATUS_CANCELED
    assert world.can_m == pytest.approx(before, abs=0.02)
    world.robot.wait(1.0)
    for side in ('left', 'right'):
        assert world.joint_rad(f'{side}_elbow') == pytest.approx(-0.5, abs=0.1)


def test_a_can_is_taken_and_put_down(
    running: tuple[TableWorld, Manipulator],
) -> None:
    """It is in the hand, and then on the table."""
    world, manipulator = running
    world.remember()
    world.robot.wait(0.5)
    end = world.act('pick', object='red can')
    assert end.status == GoalStatus.STATUS_SUCCEEDED, end.result.error_msg
    assert end.result.object == 'red_can_1'
    states = world.states('pick')
    assert states[-1] == 'carrying' and 'closing' in states
    world.robot.wait(3.0)
    assert world.can_m[2] > 0.80
    pose = world.robot.pose.position_m
    assert math.hypot(world.can_m[0] - pose.real, world.can_m[1] - pose.imag) < 0.5
    busy = world.act('pick', object='red can', side=end.result.side)
    assert busy.result.error_code == Pick.Result.OCCUPIED_HAND
    # As after a restart: what the hand holds is felt, not remembered.
    held = manipulator.held.pop(end.result.side)
    busy = world.act('pick', object='red can', side=end.result.side)
    assert busy.result.error_code == Pick.Result.OCCUPIED_HAND
    assert 'something' in busy.result.error_msg
    manipulator.held[end.result.side] = held

    down = world.act('place', place='table')
    assert down.status == GoalStatus.STATUS_SUCCEEDED, down.result.error_msg
    world.robot.wait(1.0)
    x, y, z = world.can_m
    assert z == pytest.approx(0.76, abs=0.02)
    assert (x, y) == pytest.approx((down.result.position.x, down.result.position.y), abs=0.06)


@pytest.mark.story
def test_a_can_is_handed_over(world: TableWorld) -> None:
    """It is in the hand, and then in the hand of somebody who pulls."""
    world.remember()
    world.robot.wait(0.5)
    assert world.act('pick', object='can').status == GoalStatus.STATUS_SUCCEEDED
    handed = world.start('hand_over')
    world.ros.wait_until(
        lambda: 'waiting' in world.states('hand_over'), PATIENCE_S, 'a hand that is held out'
    )
    world.robot.wait(2.0)
    assert 'opening' not in world.states('hand_over')
    world.pull()
    end = world.end_of('hand_over', handed)
    assert end.status == GoalStatus.STATUS_SUCCEEDED, end.result.error_msg
    assert world.act('drop').result.error_code == Drop.Result.EMPTY_HAND
