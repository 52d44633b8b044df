# SPDX-License-Identifier: Apache-2.0
"""The robot of a costmap: its footprint and pose."""

from __future__ import annotations

from collections.abc import Callable

from geometry_msgs.msg import Polygon, PolygonStamped
from nav2_costmap_2d.costmap_messages import corners_of
from nav2_costmap_2d.costmap_parameters import CostmapParameters
from nav2_costmap_2d.footprint import Footprint
from nav2_util.geometry import Pose2D
from nav2_util.lifecycle_node import LifecycleNode
from nav2_util.parameters import ParameterSet
from nav2_util.timing import now_s
from nav2_util.transforms import TransformError
import numpy as np

__all__ = ['Robot']

_QUIET_S = 5.0


class Robot:
    """
    Robot of a costmap: its footprint, which may come from a topic, and its pose.

    Parameters
    ----------
    node
        The costmap's node.
    settings
        Its parameters.
    on_change
        Callback with a new footprint.

    """

    def __init__(
        self,
        node: LifecycleNode,
        settings: ParameterSet[CostmapParameters],
        on_change: Callable[[Footprint], None],
    ) -> None:
        self._node, self._settings, self._on_change = node, settings, on_change
        self._started_s = 0.0
        self._is_known = False
        self.shape = Footprint.of_radius(0.1)
        """The newest footprint."""

    def listen(self) -> None:
        """Subscribe to the topic `footprint`."""
        if self._settings.current.subscribe_to_stamped_footprint:
            self._node.create_subscription(
                PolygonStamped, 'footprint', lambda stamped: self._take(stamped.polygon), 10
            )
        else:
            self._node.create_subscription(Polygon, 'footprint', self._take, 10)

    def set_shape(self, shape: Footprint) -> None:
        """
        Set the footprint; call `on_change` if it differs.

        Parameters
        ----------
        shape
            The footprint with padding, in the base frame.

        """
        old, self.shape = self.shape, shape
        is_same = (
            shape.is_circular == old.is_circular
            and shape.points.shape == old.points.shape
            and np.allclose(shape.points, old.points)
        )
        if not is_same:
            self._on_change(shape)

    def await_pose(self) -> None:
        """Start waiting for the first pose."""
        self._started_s, self._is_known = now_s(self._node), False

    def pose(self) -> Pose2D:
        """
        Look up the pose of the robot in the frame of the costmap.

        Raises
        ------
        TransformError
            It is not available, or older than `transform_tolerance`.

        """
        settings = self._settings.current
        return self._node.transforms.pose_of(
            settings.robot_base_frame,
            settings.global_frame,
            not_older_s=settings.transform_tolerance,
        )

    def find(self) -> Pose2D | None:
        """Look up the pose as `pose` does; log if it is unavailable."""
        try:
            pose = self.pose()
        except TransformError as error:
            waited_s = now_s(self._node) - self._started_s
            log = self._node.get_logger()
            if self._is_known or waited_s > self._settings.current.initial_transform_timeout:
                log.error(str(error), throttle_duration_sec=_QUIET_S)
            else:
                log.info(f'Waiting: {error}', throttle_duration_sec=_QUIET_S)
            return None
        self._is_known = True
        return pose

    def _take(self, polygon: Polygon) -> None:
        points = corners_of(polygon)
        if len(points) < 3 or not np.isfinite(points).all():
            self._node.get_logger().error(
                f'Ignored a footprint of {len(points)} points: it needs at least three corners, '
                'all finite.'
            )
            return
        self.set_shape(Footprint.of_points(points, self._settings.current.footprint_padding))
