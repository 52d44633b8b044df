# SPDX-License-Identifier: Apache-2.0
"""Client of the controllers of the arms and the waist."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager

from humanoid_common.errors import UserError
from humanoid_common.goal_guard import GoalGuard
from humanoid_common.joint_mover import JointMover, trajectory_point
from humanoid_common.periodic import clock_s
from humanoid_common.qos import LATCHED, SENSOR
from humanoid_common.single_goal import GoalAborted, RunningGoal
from humanoid_description.drives import SIDES
from humanoid_description.loading import load_robot
from humanoid_description.robot import Array
from humanoid_manipulation.arm_trajectory import ArmTrajectory
from humanoid_manipulation.arm_world import ArmWorld
from humanoid_manipulation.obstacle import Obstacle
from humanoid_manipulation.upper_body import Reach, UpperBody
import numpy as np
from rclpy.node import Node
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from trajectory_msgs.msg import JointTrajectoryPoint

__all__ = ['Arms']

_CODE, _BLOCKED = 'ARM_FAILED', 'BLOCKED'
_OFF_RAD, _LATE_GOAL_S = 0.3, 1.0
"""Path tolerance and goal time tolerance: a joint that exceeds them has hit something."""
_STILL_RAD = 1e-3
"""The waist is not moved for a smaller turn."""
_LATE_S = 5.0
"""How much longer than planned a motion may take."""


class Arms:
    """
    Interface to the upper body: its model, its joint states and its controllers.

    It subscribes to the joint states only while a goal runs, because of their rate.

    Parameters
    ----------
    node
        The node that owns the subscriptions and the action clients.
    guard
        Cancels joint motions when this process ends.

    """

    def __init__(self, node: Node, guard: GoalGuard) -> None:
        self._node, self._guard = node, guard
        self._body: UpperBody | None = None
        self._urdf = self._prefix = ''
        self._reason = 'No robot_description received. Start robot_state_publisher.'
        self._movers: dict[str, JointMover] = {}
        self._waist: JointMover | None = None
        self._positions: dict[str, float] = {}
        self._efforts: dict[str, float] = {}
        self._listening = 0
        node.create_subscription(String, 'robot_description', self._read, LATCHED)

    @property
    def body(self) -> UpperBody:
        """Return the upper body; raises GoalAborted while there is no valid robot description."""
        if self._body is None:
            raise GoalAborted(_CODE, self._reason)
        return self._body

    @contextmanager
    def listening(self) -> Iterator[None]:
        """Subscribe to the joint states in the enclosed block."""
        self._positions = {}
        self._listening += 1
        subscription = self._node.create_subscription(
            JointState, 'joint_states', self._take, SENSOR
        )
        try:
            yield
        finally:
            self._listening -= 1
            self._node.destroy_subscription(subscription)

    @property
    def is_listening(self) -> bool:
        """Whether a goal that uses the arms runs."""
        return self._listening > 0

    async def wait(self, goal: RunningGoal) -> None:
        """
        Wait for the robot description, the controllers and the joint states. Call in `listening`.

        Parameters
        ----------
        goal
            The goal.

        Raises
        ------
        GoalAborted
            The robot description, a controller, or a joint's state does not become available.
        GoalCanceled
            The goal is canceled.

        """
        if not await goal.comes(lambda: not self._missing()):
            raise GoalAborted(_CODE, self._missing())

    def reach_of(self, side: str) -> Reach:
        """
        Return the measured posture of an arm and the waist. Call after `wait`.

        Parameters
        ----------
        side
            `left` or `right`.

        Returns
        -------
        Reach
            The positions of the waist and of the six joints (rad).

        """
        at = self._positions
        arm = self.body.arms[side]
        return Reach(at[self.body.waist], tuple(at[joint] for joint in arm.joints))

    def grip_of(self, side: str) -> tuple[float, float]:
        """
        Return the measured gap and force of a gripper. Call in `listening`.

        Parameters
        ----------
        side
            `left` or `right`.

        Returns
        -------
        tuple
            The gap between the fingers (m), and the force (N): positive if it opens them.

        """
        finger = self.finger_of(side)
        return 2.0 * self._positions.get(finger, 0.0), self._efforts.get(finger, 0.0)

    def finger_of(self, side: str) -> str:
        """
        Return the joint of the finger of a gripper; the thumb mirrors it.

        Parameters
        ----------
        side
            `left` or `right`.

        """
        return f'{self._prefix}{side}_gripper'

    def efforts_of(self, side: str) -> Array:
        """
        Return the measured joint torques of an arm. Call in `listening`.

        Parameters
        ----------
        side
            `left` or `right`.

        Returns
        -------
        Array
            The torques (6,) in N m, from the shoulder down; zero for joints that report none.

        """
        joints = self.body.arms[side].joints
        return np.array([self._efforts.get(joint, 0.0) for joint in joints])

    def world(
        self,
        obstacles: Sequence[Obstacle],
        held: Mapping[str, Obstacle],
        clearance_m: float,
    ) -> ArmWorld:
        """
        Create a collision checker at the current joint positions.

        Parameters
        ----------
        obstacles
            The obstacles, in the pelvis frame.
        held
            The boxes of held objects, each in its gripper frame, by side.
        clearance_m
            The clearance that the arms must keep.

        """
        world = ArmWorld(self._urdf, self.body, obstacles, held, clearance_m)
        world.stand(self._positions)
        return world

    async def move(
        self,
        goal: RunningGoal,
        side: str,
        motion: ArmTrajectory,
        tell: Callable[[], None] = lambda: None,
    ) -> None:
        """
        Execute a motion of an arm, and of the waist if it has to turn; wait until it is complete.

        Parameters
        ----------
        goal
            The goal.
        side, motion
            The side of the arm, and its motion.
        tell
            Called at 20 Hz during the motion, for feedback.

        Raises
        ------
        GoalAborted
            A controller rejected or aborted the motion, or it takes too long.

        """
        waist, arm = motion.positions_rad[:, :1], motion.positions_rad[:, 1:]
        waist_speed, arm_speed = motion.velocities_rad_s[:, :1], motion.velocities_rad_s[:, 1:]
        ways = [(self._movers[side], arm, arm_speed)]
        if np.ptp(waist) > _STILL_RAD:
            assert self._waist is not None
            ways.append((self._waist, waist, waist_speed))
        movers = [mover for mover, _, _ in ways]
        for mover, positions, velocities in ways:
            points = _points(motion.times_s, positions, velocities)
            mover.send(points, _OFF_RAD, _LATE_GOAL_S)
        end_s = clock_s(self._node) + motion.duration_s + _LATE_S
        try:
            while not all(mover.has_arrived() for mover in movers):
                if clock_s(self._node) > end_s:
                    raise GoalAborted(_CODE, f'The {side} arm did not reach its target.')
                await goal.tick()
                tell()
        except BaseException:
            for mover in movers:
                mover.stop()
            raise

    def _missing(self) -> str:
        """Return a message about what is still missing; empty if the arms are ready."""
        if self._body is None:
            return self._reason
        assert self._waist is not None
        for mover in (*self._movers.values(), self._waist):
            if not mover.is_ready:
                return f"No action server for '{mover.action}'. Start the robot's controllers."
        needed = [self._body.waist, *(j for arm in self._body.arms.values() for j in arm.joints)]
        unknown = [joint for joint in needed if joint not in self._positions]
        return f"joint_states has no position of '{unknown[0]}'." if unknown else ''

    def _take(self, message: JointState) -> None:
        self._positions.update(zip(message.name, message.position))
        self._efforts.update(zip(message.name, message.effort))

    def _read(self, message: String) -> None:
        try:
            robot = load_robot(message.data, 'robot_description')
            body = UpperBody.of(robot)
        except UserError as error:
            self._body, self._reason = None, str(error)
            return
        self._urdf, self._prefix = message.data, robot.prefix
        if not self._movers:
            self._movers = {
                side: JointMover(
                    self._node,
                    body.arms[side].joints,
                    f'{side}_arm_controller',
                    _CODE,
                    _BLOCKED,
                    self._guard,
                )
                for side in SIDES
            }
            self._waist = JointMover(
                self._node, [body.waist], 'waist_controller', _CODE, guard=self._guard
            )
        self._body = body


def _points(times_s: Array, positions: Array, velocities: Array) -> list[JointTrajectoryPoint]:
    """Build a trajectory without its first point: it starts at the last commanded positions."""
    rows = zip(times_s[1:].tolist(), positions[1:].tolist(), velocities[1:].tolist())
    return [trajectory_point(*row) for row in rows]
