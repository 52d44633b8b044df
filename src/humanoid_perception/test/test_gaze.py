# SPDX-License-Identifier: Apache-2.0
"""Test the node that moves the gaze, with a robot that has a head and a body that turns."""

from __future__ import annotations

from collections.abc import Iterator
import math
from typing import Any

from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Duration
from control_msgs.action import FollowJointTrajectory, PointHead
from geometry_msgs.msg import PointStamped, TransformStamped, Twist, Vector3
from humanoid_common.qos import COMMAND, LATCHED, STATE
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_description.expansion import humanoid_urdf
from humanoid_interfaces.action import ScanRoom
from humanoid_perception.gaze import Gaze
from humanoid_perception.gazing import HeadChain
import numpy as np
import pytest
from rclpy.action import ActionClient, ActionServer, CancelResponse
from rclpy.node import Node
from rclpy.task import Future
from sensor_msgs.msg import CameraInfo
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

NAMES = ['head_yaw', 'head_pitch']
URDF = humanoid_urdf(1.0, '')
PERIOD_S = 0.02
SUCCEEDED, ABORTED = GoalStatus.STATUS_SUCCEEDED, GoalStatus.STATUS_ABORTED
CANCELED = GoalStatus.STATUS_CANCELED


def transform(parent: str, child: str, position, rotation, stamp) -> TransformStamped:
    """Return a transform."""
    message = TransformStamped(child_frame_id=child)
    message.header.frame_id, message.header.stamp = parent, stamp
    translation = message.transform.translation
    translation.x, translation.y, translation.z = (float(each) for each in position)
    w = math.sqrt(max(0.0, 1.0 + np.trace(rotation))) / 2.0
    q = message.transform.rotation
    if w > 1e-3:
        q.w = w
        q.x = float(rotation[2, 1] - rotation[1, 2]) / (4.0 * w)
        q.y = float(rotation[0, 2] - rotation[2, 0]) / (4.0 * w)
        q.z = float(rotation[1, 0] - rotation[0, 1]) / (4.0 * w)
    else:
        q.w, q.z = 0.0, 1.0
    return message


class Robot(Node):
    """Says where its frames are, and turns head and body as it is told."""

    def __init__(self, **options: Any) -> None:
        super().__init__('robot', **options)
        self.chain = HeadChain.of(URDF, NAMES)
        self.angles = np.zeros(2)
        self.wanted = np.zeros(2)
        self.speed = 8.0
        self.heading = self.turn = 0.0
        self.thing = np.array([2.0, 0.0, 1.0])
        self.can_turn = True
        self.velocities: list[float] = []
        self._ends: list[tuple[Any, Future]] = []
        self._tf = self.create_publisher(TFMessage, '/tf', STATE)
        self._description = self.create_publisher(String, 'robot_description', LATCHED)
        self._description.publish(String(data=URDF))
        self._info = self.create_publisher(CameraInfo, 'camera/camera_info', STATE)
        self.walking = self.create_publisher(String, 'walking_state', LATCHED)
        self.create_subscription(Twist, 'cmd_vel', self._drive, COMMAND)
        self._server = ActionServer(
            self,
            FollowJointTrajectory,
            'head_controller/follow_joint_trajectory',
            self._execute,
            cancel_callback=self._cancel,
        )
        self.create_timer(PERIOD_S, self._step)
        self.create_timer(0.1, self._show)

    def _drive(self, message: Twist) -> None:
        self.turn = message.angular.z
        self.velocities.append(message.angular.z)

    def _cancel(self, _: Any) -> CancelResponse:
        self.wanted = self.angles.copy()
        return CancelResponse.ACCEPT

    async def _execute(self, handle: Any) -> Any:
        for other, end in self._ends:
            if other.is_active and not end.done():
                end.set_result(False)
        self.wanted = np.array(handle.request.trajectory.points[-1].positions)
        end: Future = Future(executor=self.executor)
        self._ends.append((handle, end))
        if await end:
            handle.succeed()
        elif handle.is_cancel_requested:
            handle.canceled()
        else:
            handle.abort()
        return FollowJointTrajectory.Result()

    def _step(self) -> None:
        """Move, and say where the frames are."""
        step = self.speed * PERIOD_S
        self.angles += np.clip(self.wanted - self.angles, -step, step)
        self.heading += self.turn * PERIOD_S * self.can_turn
        if np.abs(self.wanted - self.angles).max() < 1e-6:
            for handle, end in self._ends:
                if not end.done():
                    end.set_result(not handle.is_cancel_requested)
            self._ends.clear()
        stamp = self.get_clock().now().to_msg()
        c, s = math.cos(self.heading), math.sin(self.heading)
        body = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        optical = np.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])
        parts = [transform('odom', self.chain.base_frame, (0, 0, 0.9), body, stamp)]
        for number, joint in enumerate(self.chain.joints):
            pose = HeadChain([joint]).pose([self.angles[number]])
            parts.append(transform(joint.parent, joint.child, pose[:3, 3], pose[:3, :3], stamp))
        parts.append(transform('head', 'camera_optical_frame', (0.08, 0, 0.06), optical, stamp))
        parts.append(transform('odom', 'thing', self.thing, np.eye(3), stamp))
        self._tf.publish(TFMessage(transforms=parts))

    def _show(self) -> None:
        matrix = [207.8, 0.0, 160.0, 0.0, 207.8, 120.0, 0.0, 0.0, 1.0]
        self._info.publish(CameraInfo(width=320, height=240, k=matrix))

    def error_rad(self, target: np.ndarray) -> float:
        """Return how far the camera looks beside a point of odom."""
        tip = np.eye(4)
        tip[:3, 3] = (0.08, 0, 0.06)
        c, s = math.cos(self.heading), math.sin(self.heading)
        body = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        inside = body.T @ (target - [0.0, 0.0, 0.9])
        return self.chain.error_rad(self.angles, inside, tip, np.array([1.0, 0.0, 0.0]))


class Watcher:
    """Sends goals."""

    def __init__(self, ros: RosSandbox) -> None:
        self.ros = ros
        self.robot = ros.start(Robot)
        self.gaze = ros.start(Gaze, {'max_velocity': 6.0, 'turn_rate_rad_s': 2.0})
        self.node = ros.observer()
        self.feedback: list[Any] = []
        self.look = ActionClient(self.node, PointHead, 'look_at')
        self.scan = ActionClient(self.node, ScanRoom, 'scan_room')
        for client in (self.look, self.scan):
            ros.wait_until(client.server_is_ready, what='the actions')

    def send(self, client: ActionClient, goal: Any) -> Any:
        """Return the handle of a goal."""
        future = client.send_goal_async(goal, lambda each: self.feedback.append(each.feedback))
        self.ros.wait_until(future.done, what='an answer')
        return future.result()

    def end(self, handle: Any) -> tuple[int, Any]:
        """Return status and result."""
        future = handle.get_result_async()
        self.ros.wait_until(future.done, 90.0, 'the end of the goal')
        return future.result().status, future.result().result

    def close(self) -> None:
        """End."""
        self.look.destroy()
        self.scan.destroy()


def look(at, frame: str = 'odom', **fields: Any) -> PointHead.Goal:
    """Return a goal."""
    target = PointStamped()
    target.header.frame_id = frame
    target.point.x, target.point.y, target.point.z = (float(each) for each in at)
    return PointHead.Goal(target=target, **fields)


@pytest.fixture()
def watcher() -> Iterator[Watcher]:
    """Run robot and node."""
    with ros_sandbox() as ros:
        one = Watcher(ros)
        yield one
        one.close()


@pytest.mark.parametrize('at', [(2.0, 0.5, 0.7), (1.0, -1.5, 1.4)])
def test_the_camera_looks_at_a_point(watcher: Watcher, at) -> None:
    """The goal succeeds when it does; the feedback says how far it is beside."""
    status, _ = watcher.end(watcher.send(watcher.look, look(at)))
    assert status == SUCCEEDED
    assert watcher.robot.error_rad(np.array(at)) < 0.06
    assert watcher.feedback[0].pointing_angle_error > watcher.feedback[-1].pointing_angle_error


def test_another_axis_may_point(watcher: Watcher) -> None:
    """That of a frame of the head, as x of the link itself."""
    goal = look((2.0, 1.0, 1.0), pointing_frame='head', pointing_axis=Vector3(x=1.0))
    status, _ = watcher.end(watcher.send(watcher.look, goal))
    assert status == SUCCEEDED
    assert watcher.robot.angles[0] == pytest.approx(math.atan2(1.0, 2.0), abs=0.08)


def test_a_thing_that_moves_is_followed_as_long_as_asked(watcher: Watcher) -> None:
    """The target is the origin of a frame that moves."""
    robot = watcher.robot
    goal = look((0, 0, 0), 'thing', min_duration=Duration(sec=4))
    robot.create_timer(PERIOD_S, lambda: robot.thing.__iadd__([0.0, 0.005, 0.0]))
    handle = watcher.send(watcher.look, goal)
    status, _ = watcher.end(handle)
    assert status == SUCCEEDED
    assert robot.thing[1] > 0.5
    assert robot.error_rad(robot.thing) < 0.15


def test_out_of_reach_the_head_turns_as_far_as_it_can(watcher: Watcher) -> None:
    """And the goal is aborted."""
    status, _ = watcher.end(watcher.send(watcher.look, look((-3.0, 0.3, 1.0))))
    assert status == ABORTED
    assert watcher.robot.angles[0] == pytest.approx(1.4, abs=0.05)


def test_a_newer_goal_takes_over(watcher: Watcher) -> None:
    """The older one is aborted."""
    watcher.robot.speed = 0.3
    first = watcher.send(watcher.look, look((1.0, 2.0, 1.0)))
    second = watcher.send(watcher.look, look((2.0, -0.1, 1.0)))
    assert watcher.end(first)[0] == ABORTED
    watcher.robot.speed = 8.0
    assert watcher.end(second)[0] == SUCCEEDED
    assert watcher.robot.error_rad(np.array([2.0, -0.1, 1.0])) < 0.06


def test_a_canceled_look_stops_the_head(watcher: Watcher) -> None:
    """Where it is."""
    robot = watcher.robot
    robot.speed = 0.2
    handle = watcher.send(watcher.look, look((0.5, 2.0, 1.0)))
    watcher.ros.wait_until(lambda: robot.angles[0] > 0.05, what='a head that moves')
    watcher.ros.wait_until(handle.cancel_goal_async().done, what='the cancel')
    assert watcher.end(handle)[0] == CANCELED
    watcher.ros.wait_until(lambda: np.array_equal(robot.angles, robot.wanted), what='rest')
    assert robot.angles[0] < 1.0


@pytest.mark.parametrize(
    'goal',
    [look((1, 0, 1), ''), look((math.nan, 0, 1)), look((1, 0, 1), max_velocity=-1.0)],
    ids=['no frame', 'NaN', 'negative'],
)
def test_a_goal_without_sense_is_rejected(watcher: Watcher, goal: PointHead.Goal) -> None:
    """At once."""
    assert not watcher.send(watcher.look, goal).accepted


def test_a_frame_that_nobody_knows_ends_the_goal(watcher: Watcher) -> None:
    """After a while."""
    assert watcher.end(watcher.send(watcher.look, look((1, 0, 1), 'nowhere')))[0] == ABORTED


def test_the_head_looks_around(watcher: Watcher) -> None:
    """All that it can see, and the body stays."""
    status, result = watcher.end(watcher.send(watcher.scan, ScanRoom.Goal()))
    assert (status, result.error_code, result.error_msg) == (SUCCEEDED, 0, '')
    assert result.coverage > 0.97
    assert watcher.robot.velocities == []
    shares = [each.coverage for each in watcher.feedback]
    assert shares == sorted(shares)
    assert len(shares) > 3


def test_with_the_body_it_sees_all_around(watcher: Watcher) -> None:
    """The body turns, and stands at the end."""
    status, result = watcher.end(watcher.send(watcher.scan, ScanRoom.Goal(turn_body=True)))
    assert (status, result.error_msg) == (SUCCEEDED, '')
    assert result.coverage > 0.95
    assert watcher.robot.heading > 2.0
    assert watcher.robot.velocities[-1] == 0.0


def test_a_body_that_does_not_turn_is_said(watcher: Watcher) -> None:
    """After a while, and it is told to stand."""
    watcher.robot.can_turn = False
    status, result = watcher.end(watcher.send(watcher.scan, ScanRoom.Goal(turn_body=True)))
    assert (status, result.error_code) == (ABORTED, ScanRoom.Result.BODY_FAILED)
    assert 'does not turn' in result.error_msg
    assert watcher.robot.velocities[-1] == 0.0
    assert 0.2 < result.coverage < 0.9


def test_a_look_around_ends_in_time(watcher: Watcher) -> None:
    """If it was given any."""
    goal = ScanRoom.Goal(time_allowance=Duration(sec=1))
    status, result = watcher.end(watcher.send(watcher.scan, goal))
    assert (status, result.error_code) == (ABORTED, ScanRoom.Result.TIMEOUT)
    assert result.error_msg


@pytest.mark.parametrize('state', ['fallen', 'stand_up'])
def test_a_robot_that_falls_moves_no_more(watcher: Watcher, state: str) -> None:
    """The scan ends with the reason, and the body gets no more turns."""
    handle = watcher.send(watcher.scan, ScanRoom.Goal(turn_body=True))
    watcher.ros.wait_until(lambda: watcher.robot.turn > 0.0, 90.0, 'a body that turns')
    watcher.robot.walking.publish(String(data=state))
    status, result = watcher.end(handle)
    assert (status, result.error_code) == (ABORTED, ScanRoom.Result.INHIBITED)
    assert len(result.error_msg.split()) > 3
    watcher.ros.wait_until(lambda: watcher.robot.turn == 0.0, what='a body that stands')


def test_a_canceled_look_around_stops_head_and_body(watcher: Watcher) -> None:
    """And says what it has seen."""
    handle = watcher.send(watcher.scan, ScanRoom.Goal(turn_body=True))
    watcher.ros.wait_until(lambda: watcher.robot.turn > 0.0, 90.0, 'a body that turns')
    watcher.ros.wait_until(handle.cancel_goal_async().done, what='the cancel')
    status, result = watcher.end(handle)
    assert status == CANCELED
    assert result.coverage > 0.2
    watcher.ros.wait_until(lambda: watcher.robot.turn == 0.0, what='a body that stands')
