# SPDX-License-Identifier: Apache-2.0
"""Check that the robot knows what stands on the table in front of it, and where."""

from __future__ import annotations

import cmath
from collections.abc import Callable, Iterator
import math
from pathlib import Path
from typing import Any

from action_msgs.msg import GoalStatus
from control_msgs.action import PointHead
from humanoid_common.testing.launching import running_launch_file
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_interfaces.action import ScanRoom
from humanoid_interfaces.msg import RememberedObject
from humanoid_interfaces.srv import FindObjects
from humanoid_simulation.scene import load_scene
from humanoid_simulation.testing.simulators import RobotClient
import pytest
from rclpy.action import ActionClient
from simulation_interfaces.srv import GetEntityState, SetEntityState

LAUNCH_FILE = Path(__file__).parents[1] / 'launch' / 'bringup.launch.py'
STAND_M = complex(0.75, 2.1)
ON_THE_TABLE = ('red_mug', 'blue_mug', 'green_apple')


class SeeingRobot:
    """A robot that stands at the kitchen table, and has looked at it."""

    def __init__(self, ros: RosSandbox) -> None:
        self._ros = ros
        self._robot = RobotClient(ros)
        self._node = ros.observer()
        self._robot.wait(1.0)
        self._turn_round()
        self._put_at_the_table()

    def _turn_round(self) -> None:
        robot = self._robot
        robot.drive(turn=0.6)
        assert robot.wait_until(lambda: math.cos(robot.pose.yaw_rad) < -0.99, 15.0)
        robot.drive()
        robot.wait(2.0)

    def _put_at_the_table(self) -> None:
        request = GetEntityState.Request(entity='robot')
        state = self.call(GetEntityState, 'simulator/get_entity_state', request).state
        state.pose.position.x, state.pose.position.y = STAND_M.real, STAND_M.imag
        change = SetEntityState.Request(entity='robot', state=state)
        answer = self.call(SetEntityState, 'simulator/set_entity_state', change)
        assert answer.result.result == 1, answer.result.error_message
        self._robot.wait(2.0)

    def call(self, kind: type, name: str, request: Any) -> Any:
        """Return the answer of a service."""
        client = self._node.create_client(kind, name)
        self._ros.wait_until(client.service_is_ready, what=name)
        future = client.call_async(request)
        self._ros.wait_until(future.done, what=name)
        return future.result()

    def do(
        self, kind: type, name: str, goal: Any, feedback: Callable[[Any], None] | None = None
    ) -> Any:
        """Return the result of an action."""
        client = ActionClient(self._node, kind, name)
        self._ros.wait_until(client.server_is_ready, what=name)
        sent = client.send_goal_async(goal, feedback)
        self._ros.wait_until(sent.done, what=name)
        result = sent.result().get_result_async()
        self._ros.wait_until(result.done, 120.0, what=name)
        assert result.result().status == GoalStatus.STATUS_SUCCEEDED, result.result()
        return result.result().result

    def find(self, class_id: str, colour: str = '') -> list[RememberedObject]:
        """Return what is remembered of a kind."""
        answer = self.call(
            FindObjects, 'find_objects', FindObjects.Request(class_id=class_id, colour=colour)
        )
        assert answer.success, answer.message
        assert answer.header.frame_id == 'odom'
        return list(answer.objects)

    def in_world(self, found: RememberedObject) -> complex:
        """Return where a remembered thing truly would be."""
        at, truth = self._robot.topics.odometry, self._robot.pose
        here = complex(found.pose.pose.position.x, found.pose.pose.position.y)
        off_m = (here - at.position_m) * cmath.exp(1j * (truth.yaw_rad - at.yaw_rad))
        return truth.position_m + off_m


@pytest.fixture(scope='module')
def robot() -> Iterator[SeeingRobot]:
    arguments = ('scene:=apartment', 'perception:=true', 'gui:=false', 'real_time_factor:=0.7')
    with ros_sandbox() as ros, running_launch_file(LAUNCH_FILE, *arguments):
        robot = SeeingRobot(ros)
        scan = robot.do(ScanRoom, 'scan_room', ScanRoom.Goal())
        assert scan.error_code == ScanRoom.Result.NONE, scan.error_msg
        assert scan.coverage > 0.9
        yield robot


@pytest.mark.parametrize('name', ON_THE_TABLE)
def test_things_on_the_table_are_remembered_where_they_are(robot: SeeingRobot, name: str):
    (thing,) = (each for each in load_scene('apartment').objects if each.name == name)
    found = robot.find(thing.kind, thing.colour)
    assert len(found) == 1, found
    assert abs(robot.in_world(found[0]) - complex(*thing.position_m[:2])) < 0.1
    assert found[0].pose.pose.position.z == pytest.approx(thing.position_m[2], abs=0.08)


def test_the_head_looks_at_what_was_found(robot: SeeingRobot):
    (mug,) = robot.find('mug', 'red')
    goal = PointHead.Goal()
    goal.target.header.frame_id = 'odom'
    goal.target.point = mug.pose.pose.position
    errors_rad: list[float] = []

    def take(message: Any) -> None:
        errors_rad.append(message.feedback.pointing_angle_error)

    robot.do(PointHead, 'look_at', goal, take)
    assert errors_rad[-1] < 0.06 < max(errors_rad)
