# SPDX-License-Identifier: Apache-2.0
"""Costmap publisher: the whole map to new subscribers and when it moves, else updates."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from geometry_msgs.msg import PolygonStamped
from map_msgs.msg import OccupancyGridUpdate
from nav2_costmap_2d.costmap_messages import (
    make_costmap_message,
    make_costmap_update,
    make_grid,
    make_grid_update,
    make_polygon,
)
from nav2_costmap_2d.costmap_parameters import CostmapParameters
from nav2_costmap_2d.footprint import transformed
from nav2_costmap_2d.grid import Costmap2D, FloatArray
from nav2_costmap_2d.layers import Layer
from nav2_costmap_2d.regions import Region
from nav2_msgs.msg import Costmap, CostmapUpdate
from nav2_util.geometry import Pose2D
from nav2_util.lifecycle_node import LifecycleNode
from nav2_util.parameters import ParameterSet
from nav2_util.qos import LATCHED
from nav_msgs.msg import OccupancyGrid
from rclpy.event_handler import PublisherEventCallbacks
from rclpy.qos import QoSProfile

__all__ = ['CostmapPublisher']


class _Topic:
    """Topic of a costmap, with its topic of updates if it has one."""

    def __init__(
        self,
        node: LifecycleNode,
        name: str,
        kinds: tuple[Any, Any | None],
        make: Callable[[Costmap2D], Any],
        make_update: Callable[[Costmap2D, Region], Any],
    ) -> None:
        self._make, self._make_update = make, make_update
        self._has_newcomers = True
        self._publisher = node.create_publisher(
            kinds[0],
            name,
            LATCHED,
            event_callbacks=PublisherEventCallbacks(matched=self._greet),
        )
        self._updates: Any = None
        if kinds[1] is not None:
            self._updates = node.create_publisher(kinds[1], f'{name}_updates', LATCHED)

    def publish(
        self, find: Callable[[], Costmap2D | None], region: Region | None, is_whole: bool
    ) -> None:
        """Publish the costmap or an update to the subscribers."""
        if self._has_newcomers or (region is not None and (is_whole or self._updates is None)):
            if self._publisher.get_subscription_count() and (grid := find()) is not None:
                self._publisher.publish(self._make(grid))
                self._has_newcomers = False
        elif region is not None and self._updates.get_subscription_count():
            grid = find()
            if grid is not None:
                self._updates.publish(self._make_update(grid, region))

    def _greet(self, status: Any) -> None:
        """Detect new subscribers, whose latched message is outdated."""
        self._has_newcomers |= status.total_count_change > 0


class CostmapPublisher:
    """
    Publisher of a costmap and of its layers to subscribers; layers are never sent as updates.

    Parameters
    ----------
    node
        The costmap's node.
    settings
        Its parameters.
    layers
        The layers.
    grid
        The costmap, for its size.

    """

    def __init__(
        self,
        node: LifecycleNode,
        settings: ParameterSet[CostmapParameters],
        layers: Sequence[Layer],
        grid: Costmap2D,
    ) -> None:
        self._node, self._settings = node, settings
        kinds = (OccupancyGridUpdate, CostmapUpdate)
        self._topics = self._make_topics('costmap', 'master', kinds)
        self._layers = [
            (layer, self._make_topics(layer.name, layer.name, (None, None)))
            for layer in layers
            if layer.costs(grid) is not None
        ]
        self._footprint = node.create_publisher(
            PolygonStamped, 'published_footprint', QoSProfile(depth=1)
        )
        self._region: Region | None = None
        self._place: tuple[Any, ...] = ()

    def _make_topics(self, topic: str, layer: str, kinds: tuple[Any, Any]) -> list[_Topic]:
        """Make the topics with scaled occupancies, and with raw costs."""
        node = self._node
        return [
            _Topic(
                node,
                topic,
                (OccupancyGrid, kinds[0]),
                lambda grid: make_grid(grid, *self._header(), self._settings.current.map_vis_z),
                lambda grid, region: make_grid_update(grid, region, *self._header()),
            ),
            _Topic(
                node,
                f'{topic}_raw',
                (Costmap, kinds[1]),
                lambda grid: make_costmap_message(grid, *self._header(), layer),
                lambda grid, region: make_costmap_update(grid, region, *self._header()),
            ),
        ]

    def add(self, region: Region | None) -> None:
        """
        Add a region to the next publication.

        Parameters
        ----------
        region
            The cells that have changed; None if none have.

        """
        self._region = self._region if region is None else region.union(self._region)

    def publish(self, grid: Costmap2D) -> None:
        """
        Publish the changes since the last publication.

        Parameters
        ----------
        grid
            The newest costmap; it is sent as a whole if its size or origin has changed.

        """
        place = (grid.cells.shape, grid.resolution, grid.origin_x, grid.origin_y)
        is_whole = place != self._place or self._settings.current.always_send_full_costmap
        if place != self._place:
            self._place, self._region = place, Region.whole(grid)
        region = None if self._region is None else self._region.clipped(grid)
        for topic in self._topics:
            topic.publish(lambda: grid, region, is_whole)
        for layer, topics in self._layers:
            for topic in topics:
                topic.publish(partial(layer.costs, grid), region, is_whole)
        self._region = None

    def publish_footprint(self, robot: Pose2D, corners: FloatArray) -> None:
        """
        Publish the footprint of the robot in the frame of the costmap.

        Parameters
        ----------
        robot
            The pose of the robot in that frame.
        corners
            The (N, 2) footprint in the frame of the robot, in m.

        """
        if not self._footprint.get_subscription_count():
            return
        message = PolygonStamped(polygon=make_polygon(transformed(corners, *robot)))
        message.header.frame_id, message.header.stamp = self._header()
        self._footprint.publish(message)

    def _header(self) -> tuple[str, Any]:
        return self._settings.current.global_frame, self._node.get_clock().now().to_msg()
