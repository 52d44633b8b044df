# SPDX-License-Identifier: Apache-2.0
"""Transforms: one tf2 buffer for all nodes of a process."""

from __future__ import annotations

from typing import Any

from nav2_util.errors import NavigationError
from nav2_util.geometry import planar_pose, Pose2D, yaw_of
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.time import Time
from tf2_ros import Buffer, TransformException, TransformListener

__all__ = ['TransformError', 'Transforms']


class TransformError(NavigationError):
    """A transform is not available, or not at that time."""


class _Shared:
    """Shared tf2 buffer of a process, and the node that fills it."""

    def __init__(self, node: Node) -> None:
        self.users = 0
        self.node = Node(
            'transform_listener',
            namespace=node.get_namespace(),
            context=node.context,
            # The remappings of the process are for other nodes, such as its main node's name.
            use_global_arguments=False,
            cli_args=[
                '--ros-args',
                *(
                    word
                    for topic in ('/tf', '/tf_static')
                    for word in ('-r', f'{topic}:={node.resolve_topic_name(topic)}')
                ),
            ],
            enable_rosout=False,
            start_parameter_services=False,
            parameter_overrides=[
                Parameter('use_sim_time', value=node.get_parameter('use_sim_time').value)
            ],
        )
        self.buffer = Buffer(node=self.node)
        self.listener = TransformListener(self.buffer, self.node)


_shared: dict[tuple[Context, str], _Shared] = {}


class Transforms:
    """
    Transforms of a node; shared by all nodes of a process that use the same topics.

    Parameters
    ----------
    node
        The node, whose topics `tf` and `tf_static` are used.

    """

    def __init__(self, node: Any) -> None:
        self._key = node.context, node.resolve_topic_name('/tf')
        if self._key not in _shared:
            _shared[self._key] = _Shared(node)
        self._entry = _shared[self._key]
        self._entry.users += 1
        self._is_open = True
        self.buffer: Buffer = self._entry.buffer
        self.node: Node = self._entry.node
        """The node with the listener, which has to be spun."""

    def close(self) -> None:
        """Release the buffer; the last user destroys its listener."""
        if not self._is_open:
            return
        self._is_open = False
        self._entry.users -= 1
        if not self._entry.users:
            del _shared[self._key]
            self._entry.listener.unregister()
            self._entry.node.destroy_node()

    def pose_of(
        self, frame: str, in_frame: str, time: Time | None = None, not_older_s: float | None = None
    ) -> Pose2D:
        """
        Look up the pose of a frame in another one.

        Parameters
        ----------
        frame, in_frame
            Names of frames.
        time
            The time; by default the newest available one.
        not_older_s
            The maximum age of the newest transform, in s; an older one is rejected.

        Raises
        ------
        TransformError
            It is not available.

        """
        try:
            found = self.buffer.lookup_transform(in_frame, frame, time or Time())
        except TransformException as error:
            raise TransformError(
                f"The pose of '{frame}' in '{in_frame}' is unknown: {error}"
            ) from error
        if not_older_s is not None:
            age = self._entry.node.get_clock().now() - Time.from_msg(
                found.header.stamp, clock_type=self._entry.node.get_clock().clock_type
            )
            if age > Duration(seconds=not_older_s) and found.header.stamp.sec:
                raise TransformError(
                    f"The pose of '{frame}' in '{in_frame}' is {age.nanoseconds * 1e-9:.2f} s "
                    f'old; the limit is {not_older_s:g} s.'
                )
        moved = found.transform
        return Pose2D(moved.translation.x, moved.translation.y, yaw_of(moved.rotation))

    def pose_in(self, pose: Any, in_frame: str) -> Pose2D:
        """
        Transform a `PoseStamped` to another frame by the newest transform, ignoring its stamp.

        Parameters
        ----------
        pose
            The pose, in the frame of its header.
        in_frame
            The name of the other frame.

        Returns
        -------
        Pose2D
            x and y in m, yaw in rad, in the other frame.

        Raises
        ------
        TransformError
            The frame of the pose is empty, or the transform is not available.

        """
        frame = pose.header.frame_id
        if not frame:
            raise TransformError('The pose has no frame_id. Set it, such as to map.')
        planar = planar_pose(pose.pose)
        if frame == in_frame:
            return planar
        return self.pose_of(frame, in_frame, Time()) @ planar
