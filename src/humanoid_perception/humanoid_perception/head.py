# SPDX-License-Identifier: Apache-2.0
"""The head of the robot, moved by its trajectory controller and seen by its transforms."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Duration
from control_msgs.action import FollowJointTrajectory
from humanoid_common.qos import LATCHED
from humanoid_common.single_goal import GoalAborted, RunningGoal
from humanoid_perception.gazing import HeadChain, HeadError
from humanoid_perception.memory_conversions import pose_of
import numpy as np
import numpy.typing as npt
from rclpy.action import ActionClient
from rclpy.node import Node
from rclpy.time import Time
from std_msgs.msg import String
from tf2_ros import Buffer, TransformException, TransformListener
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

__all__ = ['Head']

Array = npt.NDArray[np.float64]
_PATIENCE_S = 5.0
_SHORTEST_S = 0.15
"""A motion takes at least this time."""


class Head:
    """
    Moves the joints of the neck, and knows where frames on it and elsewhere are.

    Transforms are listened to only while a goal runs, since they come all the time.

    Parameters
    ----------
    node
        The node whose topics count.
    joints
        The names of the joints, from the body on.
    controller
        The name of their trajectory controller.

    """

    def __init__(self, node: Node, joints: Sequence[str], controller: str) -> None:
        self._node, self._names = node, list(joints)
        self._action = f'{controller}/follow_joint_trajectory'
        self._client = ActionClient(node, FollowJointTrajectory, self._action)
        self._known: HeadChain | None = None
        self._reason = 'No robot_description has come. Start robot_state_publisher.'
        self._buffer: Buffer | None = None
        self._sent: Any = None
        self._handle: Any = None
        self._end: Any = None
        node.create_subscription(String, 'robot_description', self._read, LATCHED)

    @property
    def chain(self) -> HeadChain:
        """Return the joints; GoalAborted if they are not known."""
        if self._known is None:
            raise GoalAborted('HEAD_FAILED', self._reason)
        return self._known

    def _read(self, message: String) -> None:
        try:
            self._known = HeadChain.of(message.data, self._names)
        except HeadError as error:
            self._known, self._reason = None, str(error)

    @contextmanager
    def listening(self) -> Iterator[None]:
        """Listen to the transforms meanwhile."""
        self._buffer = Buffer()
        listener = TransformListener(self._buffer, self._node)
        try:
            yield
        finally:
            listener.unregister()
            self._buffer = None

    async def wait(self, goal: RunningGoal) -> None:
        """Wait until the head can be moved; abort with what is missing."""
        begin = _Patience(_PATIENCE_S)
        while not self._client.server_is_ready() or self._known is None:
            if begin.is_over():
                _ = self.chain
                raise GoalAborted(
                    'HEAD_FAILED',
                    f"The action '{self._action}' is not there. Start the robot's controllers.",
                )
            await goal.tick()
        await self.known(goal, self.chain.base_frame, self.chain.tip_frame)

    async def known(self, goal: RunningGoal, frame: str, child: str) -> Array:
        """Return the pose (4, 4) of a frame in another; wait a while for it, or abort."""
        begin = _Patience(_PATIENCE_S)
        while True:
            try:
                return self.pose(frame, child)
            except TransformException as error:
                if begin.is_over():
                    raise GoalAborted(
                        'NO_TRANSFORM', f"It is not known where '{child}' is: {error}"
                    ) from None
            await goal.tick()

    def pose(self, frame: str, child: str) -> Array:
        """Look up the newest matrix (4, 4) of a frame in another; raise TransformException."""
        assert self._buffer is not None, 'Transforms are known while they are listened to.'
        pose = np.eye(4)
        if frame != child:
            found = self._buffer.lookup_transform(frame, child, Time())
            pose[:3, 3], pose[:3, :3] = pose_of(found.transform)
        return pose

    def angles_rad(self) -> Array:
        """Return where the joints are, by the transforms."""
        chain = self.chain
        poses = [self.pose(joint.parent, joint.child)[:3, :3] for joint in chain.joints]
        return np.array([chain.angle_of(number, each) for number, each in enumerate(poses)])

    def duration_s(
        self, angles_rad: Array, fastest_rad_s: float, at_least_s: float = 0.0
    ) -> float:
        """Return how long it takes to turn to angles, from where the joints are."""
        speed = np.minimum(self.chain.velocity_rad_s, fastest_rad_s)
        # A trajectory from rest to rest is at most 1.875 times as fast as on average.
        needed = float(np.max(np.abs(angles_rad - self.angles_rad()) * 1.9 / speed))
        return max(needed, at_least_s, _SHORTEST_S)

    def send(self, angles_rad: Array, duration_s: float) -> None:
        """Begin to turn; a motion that still goes on is replaced."""
        time = Duration(sec=int(duration_s), nanosec=int(duration_s % 1.0 * 1e9))
        point = JointTrajectoryPoint(
            positions=[float(each) for each in angles_rad], time_from_start=time
        )
        trajectory = JointTrajectory(joint_names=self._names, points=[point])
        self._handle = self._end = None
        sent = self._sent = self._client.send_goal_async(
            FollowJointTrajectory.Goal(trajectory=trajectory)
        )

        def take(future: Any) -> None:
            if sent is self._sent:
                self._handle = future.result()
                if self._handle.accepted:
                    self._end = self._handle.get_result_async()

        sent.add_done_callback(take)

    def has_arrived(self) -> bool:
        """
        Whether the motion that was begun last is over.

        Raises
        ------
        GoalAborted
            The controller rejected or aborted it.

        """
        if self._handle is not None and not self._handle.accepted:
            raise GoalAborted(
                'HEAD_FAILED',
                f"'{self._action}' rejected the motion: the log of the robot says why.",
            )
        if self._end is None or not self._end.done():
            return False
        answer = self._end.result()
        if answer.status != GoalStatus.STATUS_SUCCEEDED:
            raise GoalAborted(
                'HEAD_FAILED',
                f"'{self._action}' ended the motion: "
                f'{answer.result.error_string or "somebody else moves the head"}',
            )
        return True

    def stop(self) -> None:
        """End a motion that goes on; the head stays where it is."""
        if self._handle is not None and self._handle.accepted and not self._end.done():
            self._handle.cancel_goal_async()
        self._sent = self._handle = self._end = None


class _Patience:
    """A time by a clock that nobody stops."""

    def __init__(self, seconds: float) -> None:
        self._ticks = seconds * 20.0

    def is_over(self) -> bool:
        """Whether it is over; to be asked once a tick."""
        self._ticks -= 1.0
        return self._ticks < 0.0
