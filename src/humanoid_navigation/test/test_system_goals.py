# SPDX-License-Identifier: Apache-2.0
"""Check how goals end, and what Nav2 outlives, beside the loopback simulator."""

from __future__ import annotations

from collections.abc import Iterator
import math
import os
import signal

from action_msgs.msg import GoalStatus
from humanoid_common.testing.processes import is_alive, RunningProgram
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_navigation.arrival import Place, stamped
from humanoid_navigation.loopback_testing import (
    container_pid,
    loopback_simulator,
    LoopbackRobot,
    running_navigation,
    TICK_S,
)
from nav2_msgs.action import FollowWaypoints
from nav2_msgs.srv import ManageLifecycleNodes
import pytest
from rclpy.action import ActionClient

pytestmark = pytest.mark.timeout(600)

SPEED = 2.0
REACHED_M = 0.3
HALL: Place = (0.0, 0.0, 0.0)
PLACES: list[Place] = [(2.5, 0.2, 1.5), (1.0, 1.8, 3.0), (-2.0, 0.0, -1.5), (0.2, -1.7, 0.0), HALL]
IN_A_WALL: Place = (5.3, 3.3, 0.0)
"""So deep in what is occupied that no place near it can be reached."""
OUTSIDE: Place = (40.0, 0.0, 0.0)
MOST_S = 20.0


@pytest.fixture(scope='module')
def ros() -> Iterator[RosSandbox]:
    """Give a domain of its own."""
    with ros_sandbox() as sandbox:
        yield sandbox


@pytest.fixture(scope='module')
def navigation(ros: RosSandbox) -> Iterator[RunningProgram]:
    """Run the simulator and Nav2."""
    with loopback_simulator(SPEED), running_navigation() as program:
        yield program


@pytest.fixture(scope='module')
def robot(ros: RosSandbox, navigation: RunningProgram) -> LoopbackRobot:
    """Put the robot into the hall."""
    robot = LoopbackRobot(ros)
    robot.wait_for_active()
    robot.put(HALL)
    return robot


@pytest.fixture(autouse=True)
def no_traceback(navigation: RunningProgram) -> Iterator[None]:
    """Nothing fails behind the scenes."""
    yield
    assert 'Traceback' not in navigation.output


def test_goals_are_reached(robot: LoopbackRobot) -> None:
    """One after another; a benchmark sends the robot a hundred times through all rooms."""
    for place in PLACES[:2]:
        outcome = robot.go(place)
        assert outcome.is_reached, outcome
        assert outcome.distance_m < REACHED_M, outcome


@pytest.mark.parametrize('place', [IN_A_WALL, OUTSIDE])
def test_an_unreachable_goal_is_given_up(robot: LoopbackRobot, place: Place) -> None:
    """With the reason, before long."""
    outcome = robot.go(place)
    assert outcome.status == GoalStatus.STATUS_ABORTED
    assert outcome.error_code != 0
    assert len(outcome.error_msg.split()) > 3, outcome
    assert outcome.took_s < MOST_S


def test_a_missed_waypoint_is_named(robot: LoopbackRobot) -> None:
    """The others are reached, and the one that is not has its number and a code."""
    client = ActionClient(robot.node, FollowWaypoints, 'follow_waypoints')
    places = [(0.6, 0.0, 0.0), OUTSIDE, (0.0, 0.0, 3.1)]
    goal = FollowWaypoints.Goal(poses=[stamped(place) for place in places])
    handle = robot.send_goal(client, goal)
    robot.wait_until(handle.end.done, 120.0, 'the end of the waypoints')
    result = handle.end.result().result
    client.destroy()
    assert [missed.index for missed in result.missed_waypoints] == [1]
    assert result.missed_waypoints[0].error_code != 0
    assert result.error_msg


def test_a_newer_goal_takes_over(robot: LoopbackRobot) -> None:
    """The older one ends as aborted, and says why."""
    older = robot.send(PLACES[0])
    robot.wait_until(lambda: robot.is_driven)
    newer = robot.go(PLACES[2])
    assert newer.is_reached
    assert newer.distance_m < REACHED_M
    older = robot.finish(older, PLACES[0])
    assert older.status == GoalStatus.STATUS_ABORTED
    assert older.error_msg


def test_canceling_stops_the_robot(robot: LoopbackRobot) -> None:
    """The velocity is zero at once, and stays so."""
    place = max(PLACES, key=lambda each: math.dist(each[:2], robot.place[:2]))
    handle = robot.send(place)
    robot.wait_until(lambda: robot.is_driven and robot.commands[-1][1].linear.x > 0.15)
    begin_s = robot.now_s
    cancel = handle.cancel_goal_async()
    robot.wait_until(lambda: not robot.is_driven, what='a robot that stands')
    # Time goes on in ticks, and nobody here knows it better than by one; two ticks pass, three
    # do not. Differences of such times are not exact.
    assert robot.commands[-1][0] - begin_s < 0.1 + 2.5 * TICK_S
    robot.answer(cancel)
    assert robot.finish(handle, place).status == GoalStatus.STATUS_CANCELED
    count = len(robot.commands)
    robot.wait(1.0)
    assert not any(velocity.linear.x for _, velocity in robot.commands[count:])


def test_it_goes_down_and_up(robot: LoopbackRobot, navigation: RunningProgram) -> None:
    """Several times, by the manager of lifecycles, and works then."""
    commands = ManageLifecycleNodes.Request.RESET, ManageLifecycleNodes.Request.STARTUP
    for _ in range(3):
        for command in commands:
            response = robot.call(
                ManageLifecycleNodes,
                'lifecycle_manager_navigation/manage_nodes',
                ManageLifecycleNodes.Request(command=command),
            )
            assert response.success, navigation.output[-5000:]
    assert robot.state_of('controller_server') == 'active'
    outcome = robot.go(PLACES[3])
    assert outcome.is_reached, outcome


def test_it_comes_back_after_its_process_was_killed(
    robot: LoopbackRobot, navigation: RunningProgram
) -> None:
    """In the middle of a goal; all nodes are active again, and the next goal works."""
    robot.send(PLACES[0])
    robot.wait_until(lambda: robot.is_driven)
    pid = container_pid(navigation)
    os.kill(pid, signal.SIGKILL)
    robot.wait_until(lambda: not is_alive(pid))
    robot.wait_until(lambda: container_pid(navigation) != pid, what='a new process')
    robot.wait_for_active()
    robot.put(HALL)
    outcome = robot.go((0.8, 0.0, 0.0))
    assert outcome.is_reached, outcome
