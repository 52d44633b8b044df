# SPDX-License-Identifier: Apache-2.0
"""The head of the robot, moved by its trajectory controller and seen by its transforms."""

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
"""A motion takes at least this time."""


class Head(Transforms):
    """
    Moves the joints of the neck, and knows where frames on it and elsewhere are.

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
        super().__init__(node)
        self._names = list(joints)
        self._mover = JointMover(node, joints, controller, 'HEAD_FAILED')
        self._known: HeadChain | None = None
        self._reason = 'No robot_description has come. Start robot_state_publisher.'
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

    async def wait(self, goal: RunningGoal) -> None:
        """
        Wait until the head can be moved; call it while the transforms are listened to.

        Parameters
        ----------
        goal
            The goal that needs the head, and whose end ends the wait.

        Raises
        ------
        GoalAborted
            The robot description, the controller or the transforms of the neck do not come; the
            message says which. Or the goal is to end.
        GoalCanceled
            The client has canceled the goal.

        """
        if not await goal.comes(lambda: self._mover.is_ready and self._known is not None):
            _ = self.chain
            raise GoalAborted(
                'HEAD_FAILED',
                f"The action '{self._mover.action}' is not there. Start the robot's controllers.",
            )
        await self.known(goal, self.chain.base_frame, self.chain.tip_frame)

    def angles_rad(self) -> Array:
        """Return where the joints are, by the transforms."""
        chain = self.chain
        poses = [self.pose(joint.parent, joint.child)[:3, :3] for joint in chain.joints]
        return np.array([chain.angle_of(number, each) for number, each in enumerate(poses)])

    def duration_s(
        self, angles_rad: Array, fastest_rad_s: float, at_least_s: float = 0.0
    ) -> float:
        """
        Compute how long a motion from the present joint angles takes, from rest to rest.

        Parameters
        ----------
        angles_rad
            The joint angles to move to (n,).
        fastest_rad_s
            The greatest velocity of a joint, beside its own limit.
        at_least_s
            The least duration.

        Returns
        -------
        float
            The duration in s.

        Raises
        ------
        GoalAborted
            No robot description with these joints has come.
        TransformException
            It is not known where the joints are.

        """
        speed = np.minimum(self.chain.velocity_rad_s, fastest_rad_s)
        # A trajectory from rest to rest is at most 1.875 times as fast as on average.
        needed = float(np.max(np.abs(angles_rad - self.angles_rad()) * 1.9 / speed))
        return max(needed, at_least_s, _SHORTEST_S)

    def send(self, angles_rad: Array, duration_s: float) -> None:
        """
        Send a motion to the trajectory controller; one that still goes on is replaced.

        Parameters
        ----------
        angles_rad
            The joint angles to move to (n,), from the body on.
        duration_s
            How long the motion takes.

        """
        self._mover.send([trajectory_point(duration_s, angles_rad.tolist())])

    def has_arrived(self) -> bool:
        """Whether the motion that was begun last is over; GoalAborted if it failed."""
        return self._mover.has_arrived()

    def stop(self) -> None:
        """End a motion that goes on; the head stays where it is."""
        self._mover.stop()
