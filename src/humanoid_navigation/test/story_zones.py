# SPDX-License-Identifier: Apache-2.0
"""The robot keeps out of zones, and is slower in others, without physics: `make stories`."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from humanoid_common.testing.launching import running_launch_file
from humanoid_common.testing.ros import ros_sandbox
from humanoid_navigation.arrival import Place
from humanoid_navigation.loopback_testing import (
    loopback_simulator,
    LoopbackRobot,
    running_navigation,
)
import pytest

pytestmark = pytest.mark.timeout(600)

LAUNCH = Path(get_package_share_directory('humanoid_navigation')) / 'launch'
SPEED = 2.0
HALL: Place = (0.0, 0.0, 0.0)
STUDY: Place = (-2.0, 0.0, 3.1)
KEPT_OUT = ((-1.15, -0.55), (-0.75, 0.75))
"""The zone of maps/keepout_mask.yaml: x from, to; y from, to, in m."""
SLOW = ((0.6, 5.0), (-0.75, 0.7))
"""That of maps/speed_mask.yaml, where it is to be half as fast."""
FULL_SPEED_M_S = 0.4
REACTION_S = 1.5


@pytest.fixture(scope='module')
def robot() -> Iterator[LoopbackRobot]:
    """Run the simulator, Nav2 and the zones."""
    with (
        ros_sandbox() as ros,
        loopback_simulator(SPEED),
        running_navigation() as navigation,
        running_launch_file(LAUNCH / 'zones.launch.py', 'use_sim_time:=True') as zones,
    ):
        robot = LoopbackRobot(ros)
        robot.wait_for_active('speed_costmap_filter_info_server', 'bt_navigator')
        for _ in range(2):
            navigation.wait_for_output("Filter 'keepout_filter': received the mask")
        navigation.wait_for_output("Filter 'speed_filter': received the mask")
        robot.put(HALL)
        yield robot
        assert 'Traceback' not in navigation.output + zones.output


def is_in(zone: tuple[tuple[float, float], tuple[float, float]], place: Place) -> bool:
    """Tell whether a place is in a zone."""
    (x_from, x_to), (y_from, y_to) = zone
    return x_from < place[0] < x_to and y_from < place[1] < y_to


def test_it_keeps_out(robot: LoopbackRobot) -> None:
    """The way to the study leads through the living room."""
    handle = robot.send(STUDY)
    places: list[Place] = []

    def ended() -> bool:
        places.append(robot.place)
        return bool(handle.end.done())

    robot.wait_until(ended, 300.0, 'the end of the goal')
    outcome = robot.finish(handle, STUDY)
    assert outcome.is_reached, outcome
    assert not [place for place in places if is_in(KEPT_OUT, place)]
    assert min(place[1] for place in places) < -0.75


def test_a_goal_in_a_zone_is_given_up(robot: LoopbackRobot) -> None:
    """It says that there is something."""
    outcome = robot.go((-0.85, 0.0, 0.0))
    assert not is_in(KEPT_OUT, robot.place)
    assert outcome.is_reached or outcome.error_msg


def test_it_is_slower_where_it_is_told_to(robot: LoopbackRobot) -> None:
    """Half as fast in the hall, a moment after it came there, and as fast as ever before."""
    robot.put((0.0, 0.0, 0.0))
    goal = (4.2, 0.0, 0.0)
    handle = robot.send(goal)
    entered_s: float | None = None
    slow: list[float] = []

    def ended() -> bool:
        nonlocal entered_s
        if is_in(SLOW, robot.place):
            entered_s = robot.now_s if entered_s is None else entered_s
            if robot.now_s > entered_s + REACTION_S and robot.commands:
                slow.append(robot.commands[-1][1].linear.x)
        return bool(handle.end.done())

    robot.wait_until(ended, 300.0, 'the end of the goal')
    assert robot.finish(handle, goal).is_reached
    assert max(slow) <= 0.5 * FULL_SPEED_M_S + 0.02
    assert max(velocity.linear.x for _, velocity in robot.commands) > 0.6 * FULL_SPEED_M_S
