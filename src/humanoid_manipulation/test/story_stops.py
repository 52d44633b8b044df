# SPDX-License-Identifier: Apache-2.0
"""A robot that takes a can is stopped at ten moments, in three ways: `make stories`."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence, Set
import os
import signal
from typing import Any

from action_msgs.msg import GoalStatus
from humanoid_manipulation.testing import CAN_M, PATIENCE_S, table_world, TableWorld
import pytest
from std_msgs.msg import Bool

MOMENTS = (
    ('walking', 0.5), ('walking', 1.0), ('bending', 0.7), ('looking', 0.2), ('reaching', 0.7),
    ('reaching', 1.0), ('reaching', 1.3), ('closing', 0.3), ('lifting', 0.3), ('carrying', 1.5),
)  # fmt: skip
"""What the robot tells of itself, and how long after that it is stopped (s)."""
AT_REST_RAD_S = 0.15
"""Arms of a robot that only balances are slower than that."""
STOPPED_S = 0.22
"""A fifth of a second, and a period of the joint states."""
BACK_S = 60.0

pytestmark = pytest.mark.timeout(4000)


@pytest.fixture(name='world', scope='module')
def _world(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TableWorld]:
    """Give a robot before a table, whose arms are moved by a process of its own."""
    with table_world(tmp_path_factory.mktemp('stops'), 1.0) as (world, _):
        yield world


def cancel(world: TableWorld, goal: Any) -> None:
    """Cancel the goal; the robot then leaves things in order."""
    goal.cancel_goal_async()


def stop(world: TableWorld, goal: Any) -> None:
    """Stop the robot by its emergency stop."""
    world.robot.topics.emergency_stop.publish(Bool(data=True))


def kill(world: TableWorld, goal: Any) -> None:
    """Kill the node that moves the arms."""
    os.kill(world.manipulators[-1], signal.SIGKILL)


def begin(world: TableWorld) -> Any:
    """Put all in its place, and begin to take the can."""
    world.robot.reset()
    world.robot.let_go()
    world.entities.put('can', CAN_M)
    world.remember()
    world.robot.wait(0.5)
    return world.start('pick', object='can')


def wait_for_state(world: TableWorld, state: str) -> None:
    """Wait until the robot says that it does something."""
    world.ros.wait_until(
        lambda: state in world.states('pick'), PATIENCE_S, f'a robot that is {state}'
    )


def leave_in_order(
    world: TableWorld, way: Callable[..., None], goal: Any, before: Set[bytes]
) -> None:
    """Wait until the next goal can be given, and let go of what a hand may hold."""
    if way is stop:
        world.robot.wait(1.0)
        assert world.end_of('pick', goal).status == GoalStatus.STATUS_ABORTED
        world.robot.topics.emergency_stop.publish(Bool(data=False))
    elif way is cancel:
        assert world.end_of('pick', goal).status == GoalStatus.STATUS_CANCELED
    else:
        world.ros.wait_until(lambda: bool(world.endpoints - before), BACK_S, 'another manipulator')
    world.robot.wait(1.0)
    world.act('drop')


@pytest.mark.parametrize('way', [cancel, stop, kill])
def test_arms_stop_wherever_they_are(
    world: TableWorld, way: Callable[..., None], capsys: pytest.CaptureFixture[str]
) -> None:
    """Within a fifth of a second, the robot stands, and the next goal is done."""
    rows: list[Sequence[Any]] = []
    for state, after_s in MOMENTS:
        before = world.endpoints
        goal = begin(world)
        wait_for_state(world, state)
        world.robot.wait(after_s)
        begin_s, moving = world.robot.topics.time_s, world.arm_speed_rad_s
        way(world, goal)
        stopped_s = rest_s(world, begin_s)
        leave_in_order(world, way, goal, before)
        assert world.robot.stands
        end = world.end_of('pick', begin(world))
        rows.append((way.__name__, state, after_s, moving, stopped_s, end.result.error_msg))
        row = '\n| {} | {} | {:.1f} s | {:.2f} rad/s | {:.2f} s | {} |'.format(*rows[-1])
        with capsys.disabled():
            print(row, end='', flush=True)
        world.act('drop')
    assert all(row[4] <= STOPPED_S for row in rows)
    assert not any(row[5] for row in rows)


def rest_s(world: TableWorld, begin_s: float) -> float:
    """Return how long it takes until the arms are at rest for the first time."""
    world.robot.wait_until(lambda: world.arm_speed_rad_s < AT_REST_RAD_S, 10.0)
    return world.robot.topics.time_s - begin_s
