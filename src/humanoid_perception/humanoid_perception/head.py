# SPDX-License-Identifier: Apache-2.0
"""Client of the head's trajectory controller, with the joint angles from the transforms."""

from __future__ import annotations

from collections.abc import Sequence

from humanoid_common.joint_mover import JointMover, trajectory_point
from humanoid_common.qos import LATCHED
from humanoid_common.single_goal import GoalAborted, RunningGoal
from humanoid_perception.gazing import HeadChain, HeadError
from humanoid_perception.transforms import Array, Transforms
import numpy as np
from rclpy.node import Node
from std_msgs.msg import String

__all__ = ['Head']

_SHORTEST_S = 0.15
"""Least duration of a motion."""


class Head(Transforms):
    """
    Interface to the head: its joints, its trajectory controller, and the transforms.

    Parameters
    ----------
    node
        The node that owns the subscriptions and the action client.
    joints
        The names of the joints, from the body to the head.
    controller
        The name of their trajectory controller.

    """

    def __init__(self, node: Node, joints: Sequence[str], controller: str) -> None:
        super().__init__(node)
        self._names = list(joints)
        self._mover = JointMover(node, joints, controller, 'HEAD_FAILED')
        self._known: HeadChain | None = None
        self._reason = 'No robot_description received. Start robot_state_publisher.'
        node.create_subscription(String, 'robot_description', self._read, LATCHED)

    @property
    def chain(self) -> HeadChain:
        """Return the kinematic chain of the neck; raise GoalAborted if it is not known."""
        if self._known is None:
            raise GoalAborted('HEAD_FAILED', self._reason)
        return self._known

    def _read(self, message: String) -> None:
        try:
            self._known = HeadChain.of(message.data, self._names)
        except HeadError as error:
            self._known, self._reason = None, str(error)

    async def wait(self, goal: RunningGoal) -> None:
        """
        Wait until the head can be moved. Call in `listening`.

        Parameters
        ----------
        goal
            The goal that needs the head; the wait ends with it.

        Raises
        ------
        GoalAborted
            The robot description, the controller or the transforms of the neck do not become
            available; the message states which. Or the goal must end.
        GoalCanceled
            The client has canceled the goal.

        """
        if not await goal.comes(lambda: self._mover.is_ready and self._known is not None):
            _ = self.chain
            raise GoalAborted(
                'HEAD_FAILED',
                f"No action server for '{self._mover.action}'. Start the robot's controllers.",
            )
        await self.known(goal, self.chain.base_frame, self.chain.tip_frame)

    def angles_rad(self) -> Array:
        """Compute the joint angles (n,) from the transforms."""
        chain = self.chain
        poses = [self.pose(joint.parent, joint.child)[:3, :3] for joint in chain.joints]
        return np.array([chain.angle_of(number, each) for number, each in enumerate(poses)])

    def duration_s(
        self, angles_rad: Array, fastest_rad_s: float, at_least_s: float = 0.0
    ) -> float:
        """
        Compute the duration of a motion from the current joint angles, from rest to rest.

        Parameters
        ----------
        angles_rad
            The target joint angles (n,).
        fastest_rad_s
            The velocity limit, in addition to that of each joint.
        at_least_s
            The least duration.

        Returns
        -------
        float
            The duration in s.

        Raises
        ------
        GoalAborted
            No robot description with these joints was received, or their transforms are not
            available.

        """
        speed = np.minimum(self.chain.velocity_rad_s, fastest_rad_s)
        # The peak velocity of a spline from rest to rest is at most 1.875 times its mean.
        needed = float(np.max(np.abs(angles_rad - self.angles_rad()) * 1.9 / speed))
        return max(needed, at_least_s, _SHORTEST_S)

    def send(self, angles_rad: Array, duration_s: float) -> None:
        """
        Send a motion to the trajectory controller; it replaces one that is still running.

        Parameters
        ----------
        angles_rad
            The target joint angles (n,), from the body to the head.
        duration_s
            The duration of the motion.

        """
        self._mover.send([trajectory_point(duration_s, angles_rad.tolist())])

    def has_arrived(self) -> bool:
        """Check whether the last motion is complete; raise GoalAborted if it failed."""
        return self._mover.has_arrived()

    def stop(self) -> None:
        """Cancel a running motion; the head stays where it is."""
        self._mover.stop()
