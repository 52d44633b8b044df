# SPDX-License-Identifier: Apache-2.0
"""Reach with the arms of a mock robot, by the action."""

from __future__ import annotations

from collections.abc import Iterator
import math
import signal
from typing import Any

from action_msgs.msg import GoalStatus
from control_msgs.action import GripperCommand
from humanoid_common.qos import LATCHED
from humanoid_common.testing.actions import ActionCaller
from humanoid_common.testing.processes import module_command, running_program
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_control.dynamics.frames import Frame
from humanoid_control.mock_robot import MockRobot
from humanoid_description.expansion import humanoid_urdf
from humanoid_interfaces.action import Pick, Reach
from humanoid_manipulation.held_things import Held
from humanoid_manipulation.manipulator import Manipulator
from humanoid_manipulation.obstacle import Obstacle
import numpy as np
import pytest
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from vision_msgs.msg import Detection3D, Detection3DArray

PATIENCE_S = 60.0
ABOVE = (0.33, 0.25, 0.12)
"""In reach of the left hand, which points ahead there."""
ASIDE = (0.25, 0.30, 0.0)


class World:
    """A robot, what moves its arms, and a client of that."""

    def __init__(self, ros: RosSandbox, is_launched: bool = False) -> None:
        """Start all, but for what moves the arms if that was launched already."""
        self.ros, self.node = ros, ros.observer()
        self.joints: dict[str, float] = {}
        self._heard = 0
        self.feedback: list[Any] = []
        self.node.create_subscription(JointState, 'joint_states', self._hear, 10)
        self._description = self.node.create_publisher(String, 'robot_description', LATCHED)
        self._description.publish(String(data=humanoid_urdf(hands=True)))
        self.objects = self.node.create_publisher(Detection3DArray, 'objects', LATCHED)
        ros.start(MockRobot, {'hands': True})
        self.manipulator = None if is_launched else ros.start(Manipulator)
        self.caller = ActionCaller(ros, Reach, 'reach')

    def send(self, position_m: tuple[float, float, float], **fields: Any) -> Any:
        """Return the handle of a goal: a hand that points ahead."""
        goal = Reach.Goal(**fields)
        goal.pose.header.frame_id = 'base_link'
        at, turn = goal.pose.pose.position, goal.pose.pose.orientation
        at.x, at.y, at.z = position_m
        turn.w, turn.y = math.cos(math.pi / 4.0), -math.sin(math.pi / 4.0)
        self.caller.feedback.clear()
        return self.caller.send(goal)

    def put(self, position_m: tuple[float, float, float], edge_m: float) -> None:
        """Let the robot remember a cube."""
        cube = Detection3D(id='cube_1')
        at, size = cube.bbox.center.position, cube.bbox.size
        at.x, at.y, at.z = position_m
        size.x = size.y = size.z = edge_m
        self.remember(cube)

    def remember(self, *things: Detection3D) -> None:
        """Let the robot remember things."""
        message = Detection3DArray(detections=list(things))
        message.header.frame_id = 'base_link'
        self.objects.publish(message)

    def moved_rad(self, begin: dict[str, float]) -> float:
        """Return how far the joint has turned that has turned farthest since then."""
        return max(abs(self.joints[joint] - before) for joint, before in begin.items())

    def wait_for_rest(self) -> None:
        """Wait until no joint turns."""
        begin: dict[str, float] = {}
        while not begin or self.moved_rad(begin) > 1e-3:
            begin = self.joints
            self._hear_more()

    def _hear_more(self) -> None:
        """Let half a second of joints come."""
        end = self._heard + 25
        self.ros.wait_until(lambda: self._heard >= end, PATIENCE_S, 'joints')

    def _hear(self, message: JointState) -> None:
        self.joints = dict(zip(message.name, message.position))
        self._heard += 1


@pytest.fixture(name='world', scope='module')
def _world() -> Iterator[World]:
    """Give a robot in a domain of its own."""
    with ros_sandbox() as sandbox:
        world = World(sandbox)
        yield world
        world.caller.close()


def at(pose: Any) -> tuple[float, float, float]:
    """Return the position of a pose."""
    position = pose.pose.position
    return position.x, position.y, position.z


def test_the_hand_comes_to_where_it_is_asked(world: World) -> None:
    """By the arm that is nearer, and along the hand if asked."""
    end = world.caller.end_of(world.send(ABOVE, approach=0.08))
    assert end.status == GoalStatus.STATUS_SUCCEEDED, end.result.error_msg
    assert end.result.side == 'left'
    assert end.result.reached.header.frame_id == 'base_link'
    assert at(end.result.reached) == pytest.approx(ABOVE, abs=0.005)
    assert world.joints['left_elbow'] < -0.3
    told_m = [each.distance for each in world.caller.feedback]
    assert told_m[0] > 0.1 and told_m[-1] < 0.02
    mirrored = (ABOVE[0], -ABOVE[1], ABOVE[2])
    end = world.caller.end_of(world.send(mirrored))
    assert (end.status, end.result.side) == (GoalStatus.STATUS_SUCCEEDED, 'right')
    assert at(end.result.reached) == pytest.approx(mirrored, abs=0.005)


def test_what_is_out_of_reach_gets_the_nearest_pose(world: World) -> None:
    """The code and the sentence say so."""
    end = world.caller.end_of(world.send((0.9, 0.2, 0.2), side='left'))
    assert end.status == GoalStatus.STATUS_ABORTED
    assert end.result.error_code == Reach.Result.NOT_REACHABLE
    assert 'cannot get closer than' in end.result.error_msg
    assert 0.4 < at(end.result.reached)[0] < 0.8


def test_what_is_in_the_way_is_named(world: World) -> None:
    """A cube that is remembered just there."""
    world.put(ABOVE, 0.08)
    try:
        for _ in range(10):
            # What the hand touches already, it may.
            assert world.caller.end_of(world.send(ASIDE, side='left')).result.error_code == 0
            end = world.caller.end_of(world.send(ABOVE, side='left'))
            if end.status == GoalStatus.STATUS_ABORTED:
                break
        assert end.result.error_code == Reach.Result.BLOCKED
        assert 'cube 1' in end.result.error_msg
    finally:
        world.remember()


def test_cancel_stops_the_arm(world: World) -> None:
    """It goes no further."""
    world.caller.end_of(world.send(ASIDE, side='left'))
    handle = world.send((0.40, 0.25, 0.25), side='left')
    before = world.joints['left_shoulder']
    world.ros.wait_until(
        lambda: abs(world.joints['left_shoulder'] - before) > 0.05, PATIENCE_S, 'a motion'
    )
    handle.cancel_goal_async()
    assert world.caller.end_of(handle).status == GoalStatus.STATUS_CANCELED


@pytest.mark.parametrize(
    'fields', [{'side': 'middle'}, {'approach': -0.1}, {'approach': 5.0}], ids=str
)
def test_what_makes_no_sense_is_rejected(world: World, fields: dict[str, Any]) -> None:
    """Before anything moves."""
    assert not world.send(ABOVE, **fields).accepted
    assert not world.send((math.nan, 0.0, 0.0)).accepted


def test_what_is_not_remembered_is_not_seen_wherever_the_robot_is(world: World) -> None:
    """Nobody tells where the map is here."""
    caller = ActionCaller(world.ros, Pick, 'pick')
    end = caller.end_of(caller.send(object='unicorn'))
    caller.close()
    assert end.status == GoalStatus.STATUS_ABORTED
    assert end.result.error_code == Pick.Result.NOT_SEEN


def test_what_has_slipped_out_of_a_hand_is_not_held(world: World) -> None:
    """No goal needs to come for that; what is still there stays."""
    manipulator, told = world.manipulator, list[int]()
    assert manipulator is not None
    world.node.create_subscription(
        Detection3DArray,
        'held_objects',
        lambda message: told.append(len(message.detections)),
        LATCHED,
    )
    hand = ActionCaller(world.ros, GripperCommand, 'left_gripper_controller/gripper_cmd')
    grip = GripperCommand.Goal()
    grip.command.position = 0.06
    assert hand.end_of(hand.send(command=grip.command)).result.reached_goal
    assert world.caller.end_of(world.send(ASIDE, side='left')).result.error_code == 0
    box = Obstacle('mug', Frame(np.zeros(3), np.eye(3)), (0.06, 0.06, 0.1))
    manipulator.held['left'] = Held('mug_1', ('mug',), box, 0.06, np.eye(3), 0.05)
    world.wait_for_rest()
    assert 'left' in manipulator.held and told[-1] == 1
    grip.command.position = 0.0
    hand.end_of(hand.send(command=grip.command))
    world.ros.wait_until(lambda: told[-1] == 0, PATIENCE_S, 'an empty hand')
    assert not manipulator.held
    hand.close()


def test_an_arm_stops_when_its_node_is_killed() -> None:
    """It does not go on to the end of its trajectory, which takes seconds."""
    command = module_command(
        'humanoid_manipulation.manipulator', '--ros-args', '-p', 'max_velocity:=0.2'
    )
    with ros_sandbox() as ros, running_program(command) as program:
        world = World(ros, is_launched=True)
        ros.wait_until(lambda: bool(world.joints), PATIENCE_S, 'joints')
        begin = world.joints
        assert world.send(ABOVE).accepted
        ros.wait_until(lambda: world.moved_rad(begin) > 0.1, PATIENCE_S, 'an arm that moves')
        program.send(signal.SIGKILL)
        world.wait_for_rest()
        moved_rad = world.moved_rad(begin)
        world.caller.close()
    with ros_sandbox() as ros:
        world = World(ros)
        ros.wait_until(lambda: bool(world.joints), PATIENCE_S, 'joints')
        begin = world.joints
        assert world.caller.end_of(world.send(ABOVE)).status == GoalStatus.STATUS_SUCCEEDED
        assert world.moved_rad(begin) > 2.0 * moved_rad
        world.caller.close()
