# SPDX-License-Identifier: Apache-2.0
"""Open and close the grippers of a robot by their actions, as other programs do."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from action_msgs.msg import GoalStatus
from control_msgs.action import FollowJointTrajectory, GripperCommand
from controller_manager_msgs.srv import ListControllers
from humanoid_common.testing.actions import ActionCaller
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_control.mock_robot import MockRobot
from humanoid_control.testing import trajectory_goal
import pytest
from sensor_msgs.msg import JointState

ACTION = 'left_gripper_controller/gripper_cmd'
PATIENCE_S = 60.0


class World:
    """A mock robot with hands, and a client of one gripper."""

    def __init__(self, ros: RosSandbox) -> None:
        """Start the robot."""
        self.ros, self.node = ros, ros.observer()
        self.joints: dict[str, float] = {}
        self.node.create_subscription(JointState, 'joint_states', self._hear, 10)
        ros.start(MockRobot, {'hands': True})
        self.caller = ActionCaller(ros, GripperCommand, ACTION)

    def send(self, gap_m: float, most_n: float = 0.0) -> Any:
        """Return the handle of a goal."""
        goal = GripperCommand.Goal()
        goal.command.position, goal.command.max_effort = gap_m, most_n
        return self.caller.send(goal)

    def _hear(self, message: JointState) -> None:
        self.joints = dict(zip(message.name, message.position))


@pytest.fixture(name='world', scope='module')
def _world() -> Iterator[World]:
    """Give a robot in a domain of its own."""
    with ros_sandbox() as sandbox:
        world = World(sandbox)
        yield world
        world.caller.close()


def test_a_gripper_opens_and_closes(world: World) -> None:
    """Positions are gaps; joint_states has the finger, which goes half of that."""
    handle = world.send(0.08)
    assert handle.accepted
    end = world.caller.end_of(handle)
    assert end.status == GoalStatus.STATUS_SUCCEEDED
    assert end.result.reached_goal and not end.result.stalled
    assert end.result.position == pytest.approx(0.08, abs=0.004)
    assert world.caller.feedback and world.caller.feedback[0].position < 0.08
    world.ros.wait_until(
        lambda: world.joints.get('left_gripper', 0.0) == pytest.approx(0.04, abs=0.001),
        PATIENCE_S,
        'the finger',
    )
    assert world.caller.end_of(world.send(0.0)).result.reached_goal


def test_what_it_cannot_do_is_rejected(world: World) -> None:
    """A gap that is wider than the hand."""
    assert not world.send(0.2).accepted


def test_it_is_one_of_the_controllers(world: World) -> None:
    """Among those of the arms, whose wrists are theirs."""
    client = world.node.create_client(ListControllers, 'controller_manager/list_controllers')
    world.ros.wait_until(client.service_is_ready, PATIENCE_S, 'the controllers')
    future = client.call_async(ListControllers.Request())
    world.ros.wait_until(future.done, PATIENCE_S, 'the controllers')
    found = {each.name: each for each in future.result().controller}
    gripper, arm = found['left_gripper_controller'], found['left_arm_controller']
    assert gripper.type == 'position_controllers/GripperActionController'
    assert gripper.required_command_interfaces[0] == 'left_gripper/position'
    assert 'left_wrist_pitch/position' in arm.required_command_interfaces


def test_an_arm_moves_with_its_wrist(world: World) -> None:
    """A goal names all six joints."""
    client = ActionCaller(
        world.ros, FollowJointTrajectory, 'left_arm_controller/follow_joint_trajectory'
    )
    joints = ['shoulder', 'shoulder_roll', 'shoulder_yaw', 'elbow', 'wrist_yaw', 'wrist_pitch']
    goal = trajectory_goal(
        [f'left_{joint}' for joint in joints], (1.0, [0.0, 0.3, 0.0, -1.0, 0.5, -0.4])
    )
    status, _ = client.end_of(client.send(goal))
    assert status == GoalStatus.STATUS_SUCCEEDED
    world.ros.wait_until(
        lambda: world.joints.get('left_wrist_yaw', 0.0) == pytest.approx(0.5, abs=0.02),
        PATIENCE_S,
        'the wrist',
    )
    client.close()
