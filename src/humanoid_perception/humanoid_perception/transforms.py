# SPDX-License-Identifier: Apache-2.0
"""Where frames are, for goals that want to know it only while they run."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from humanoid_common.single_goal import GoalAborted, RunningGoal
from humanoid_perception.memory_conversions import pose_of
import numpy as np
import numpy.typing as npt
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import Buffer, TransformException, TransformListener

__all__ = ['Transforms']

Array = npt.NDArray[np.float64]


class Transforms:
    """
    Knows where frames are, while it listens: transforms come all the time, which costs.

    Parameters
    ----------
    node
        The node whose topics count.

    """

    def __init__(self, node: Node) -> None:
        self._node, self._buffer = node, Buffer()
        self._listens = False

    @contextmanager
    def listening(self) -> Iterator[None]:
        """Listen to the transforms meanwhile."""
        self._buffer.clear()
        listener = TransformListener(self._buffer, self._node)
        self._listens = True
        try:
            yield
        finally:
            self._listens = False
            listener.unregister()

    async def known(self, goal: RunningGoal, frame: str, child: str) -> Array:
        """
        Wait for a transform, and look it up.

        Parameters
        ----------
        goal
            The goal that needs it, and whose end ends the wait.
        frame, child
            The pose of the frame `child` in `frame` is meant.

        Returns
        -------
        Array
            The newest pose (4, 4).

        Raises
        ------
        GoalAborted
            The transform does not come within 5 s, or the goal is to end.
        GoalCanceled
            The client has canceled the goal.

        """
        await goal.comes(
            lambda: frame == child or bool(self._buffer.can_transform(frame, child, Time()))
        )
        try:
            return self.pose(frame, child)
        except TransformException as error:
            raise GoalAborted(
                'NO_TRANSFORM', f"It is not known where '{child}' is: {error}"
            ) from None

    def pose(self, frame: str, child: str) -> Array:
        """
        Look up the newest transform; call it while the transforms are listened to.

        Parameters
        ----------
        frame, child
            The pose of the frame `child` in `frame` is meant.

        Returns
        -------
        Array
            The pose (4, 4).

        Raises
        ------
        TransformException
            No transform connects the two frames.

        """
        assert self._listens, 'Transforms are known while they are listened to.'
        pose = np.eye(4)
        if frame != child:
            found = self._buffer.lookup_transform(frame, child, Time())
            pose[:3, 3], pose[:3, :3] = pose_of(found.transform)
        return pose
