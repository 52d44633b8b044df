# SPDX-License-Identifier: Apache-2.0
"""Transform lookup for goals, with a listener that is subscribed only while a goal runs."""

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
    Transform buffer that subscribes to tf only while needed, because of its rate.

    Parameters
    ----------
    node
        The node that owns the subscriptions.

    """

    def __init__(self, node: Node) -> None:
        self._node, self._buffer = node, Buffer()
        self._listens = False

    @contextmanager
    def listening(self) -> Iterator[None]:
        """Subscribe to the transforms in the enclosed block."""
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
            The goal that needs it; the wait ends with it.
        frame, child
            The target frame, and the frame whose pose in it is looked up.

        Returns
        -------
        Array
            The latest pose (4, 4).

        Raises
        ------
        GoalAborted
            The transform is not available within 5 s, or the goal must end.
        GoalCanceled
            The client has canceled the goal.

        """
        await goal.comes(
            lambda: frame == child or bool(self._buffer.can_transform(frame, child, Time()))
        )
        return self.pose(frame, child)

    def pose(self, frame: str, child: str) -> Array:
        """
        Return the latest transform. Call in `listening`.

        Parameters
        ----------
        frame, child
            The target frame, and the frame whose pose in it is looked up.

        Returns
        -------
        Array
            The pose (4, 4).

        Raises
        ------
        GoalAborted
            No transform connects the two frames.

        """
        assert self._listens, 'Transforms are not being received: call listen first.'
        pose = np.eye(4)
        if frame != child:
            try:
                found = self._buffer.lookup_transform(frame, child, Time())
            except TransformException as error:
                raise GoalAborted('NO_TRANSFORM', f"No transform of '{child}': {error}") from None
            pose[:3, 3], pose[:3, :3] = pose_of(found.transform)
        return pose
