# SPDX-License-Identifier: Apache-2.0
"""The static layer, with the map."""

from __future__ import annotations

from dataclasses import dataclass
import math
from typing import TYPE_CHECKING

from map_msgs.msg import OccupancyGridUpdate
from nav2_costmap_2d.costs import cost_table, FREE_SPACE, NO_INFORMATION
from nav2_costmap_2d.footprint import fill_polygon, transformed
from nav2_costmap_2d.grid import CellArray, Costmap2D, FloatArray
from nav2_costmap_2d.layers import Layer
from nav2_costmap_2d.regions import Region, write_maximum
from nav2_util.geometry import planar_pose, Pose2D
from nav2_util.parameters import parameter
from nav2_util.transforms import TransformError
from nav_msgs.msg import OccupancyGrid
import numpy as np
from rclpy.qos import DurabilityPolicy, QoSProfile

if TYPE_CHECKING:
    from nav2_costmap_2d.costmap_node import Costmap2DROS

__all__ = ['StaticLayer', 'StaticParameters']

_QUIET_S = 5.0


@dataclass(frozen=True)
class StaticParameters:
    """The parameters of `nav2_costmap_2d::StaticLayer`."""

    enabled: bool = parameter(True, 'Whether the layer takes part.')
    footprint_clearing_enabled: bool = parameter(
        False, 'Whether the cells below the robot are free.'
    )
    restore_cleared_footprint: bool = parameter(
        True, 'Whether such cells are again as in the map when the robot has left.'
    )
    subscribe_to_updates: bool = parameter(
        False, 'Whether parts of the map are taken from the topic `<map_topic>_updates`.'
    )
    map_subscribe_transient_local: bool = parameter(
        True, 'Whether the map is received that was published before.'
    )
    transform_tolerance: float = parameter(
        0.0, 'How old the pose of the frame of the map may be, in s; the newest counts.', low=0.0
    )
    map_topic: str = parameter('map', "The topic of the map; 'map' is that of the costmap.")


class StaticLayer(Layer):
    """
    Layer with the costs of a map. A costmap that is not rolling is resized to the map.

    Parameters
    ----------
    node
        The costmap's node.
    name
        The name of the layer.

    """

    def __init__(self, node: Costmap2DROS, name: str) -> None:
        super().__init__(name)
        self._node = node
        self._settings = node.parameters.declare(StaticParameters, name)
        self._settings.on_change = lambda _: node.touch()
        values, common = self._settings.current, node.settings
        self._table = cost_table(
            common.lethal_cost_threshold,
            common.unknown_cost_value,
            track_unknown=common.track_unknown_space,
            trinary=common.trinary_costmap,
        )
        self._map: Costmap2D | None = None
        self._map_frame = ''
        self._map_pose = Pose2D(0.0, 0.0, 0.0)
        self._changed: Region | None = None
        self._robot: Pose2D | None = None
        self._below_robot: Region | None = None
        topic = common.map_topic if values.map_topic in ('', 'map') else values.map_topic
        topic = node.resolve_beside(topic)
        durability = (
            DurabilityPolicy.TRANSIENT_LOCAL
            if values.map_subscribe_transient_local
            else DurabilityPolicy.VOLATILE
        )
        node.create_subscription(
            OccupancyGrid, topic, self._take, QoSProfile(depth=1, durability=durability)
        )
        if values.subscribe_to_updates:
            node.create_subscription(
                OccupancyGridUpdate, f'{topic}_updates', self._take_update, QoSProfile(depth=10)
            )
        node.get_logger().info(f"Layer '{name}': waiting for the map on '{topic}'")

    @property
    def is_enabled(self) -> bool:
        """Whether the layer is enabled."""
        return self._settings.current.enabled

    @property
    def is_current(self) -> bool:
        """Whether it has received a map."""
        return self._map is not None

    def update(self, grid: Costmap2D, robot: Pose2D | None) -> Region | None:
        """
        Find the region where the map is new, or where the footprint is to be cleared.

        Parameters
        ----------
        grid, robot
            As for `Layer.update`.

        Returns
        -------
        Region or None
            The cells to update, possibly beyond the grid; None if nothing has changed.

        """
        if self._map is None:
            return None
        region, self._changed = self._changed, None
        if self._follows_map_frame():
            region = Region.whole(grid)
        if self._settings.current.footprint_clearing_enabled and robot != self._robot:
            self._robot = robot
            outline = grid.world_to_map_array(self._outline())
            low, high = outline.min(axis=0), outline.max(axis=0)
            below = Region(int(low[0]), int(low[1]), int(high[0]) + 1, int(high[1]) + 1)
            region = below.union(self._below_robot).union(region)
            self._below_robot = below
        return region

    def apply(self, grid: Costmap2D, region: Region) -> None:
        """
        Write the map into the costmap, in place.

        Parameters
        ----------
        grid, region
            As for `Layer.apply`.

        """
        if self._map is None:
            return
        cells = grid.cells[region.slices]
        if self._is_same_place(grid):
            mapped: CellArray = self._map.cells[region.slices]
            is_inside = None
        else:
            points = self._points_in_map(grid, region)
            mapped = self._map.costs_at(points, outside=NO_INFORMATION)
            index = self._map.world_to_map_array(points)
            size = (self._map.size_x, self._map.size_y)
            is_inside = ((index >= 0) & (index < size)).all(axis=-1)
        if self._node.settings.use_maximum:
            write_maximum(cells, mapped)
        elif is_inside is None:
            cells[...] = mapped
        else:
            np.copyto(cells, mapped, where=is_inside)
        if self._settings.current.footprint_clearing_enabled and self._robot is not None:
            self._clear_footprint(grid, region)

    def costs(self, grid: Costmap2D) -> Costmap2D:
        """
        Return the map on the grid of the costmap; NO_INFORMATION where there is none.

        Parameters
        ----------
        grid
            As for `Layer.costs`.

        """
        found = grid.with_cells(np.full_like(grid.cells, NO_INFORMATION))
        self.apply(found, Region.whole(found))
        return found

    def _clear_footprint(self, grid: Costmap2D, region: Region) -> None:
        mask = fill_polygon(grid, self._outline())
        grid.cells[region.slices][mask[region.slices]] = FREE_SPACE
        if not self._settings.current.restore_cleared_footprint and self._map is not None:
            outline = [self._map_pose @ Pose2D(x, y, 0.0) for x, y in self._outline()]
            corners = np.array([point[:2] for point in outline])
            self._map.cells[fill_polygon(self._map, corners)] = FREE_SPACE

    def _outline(self) -> FloatArray:
        robot = self._robot or Pose2D(0.0, 0.0, 0.0)
        return transformed(self._node.footprint, *robot)

    def _take(self, message: OccupancyGrid) -> None:
        info = message.info
        cells = np.asarray(message.data, dtype=np.int8).view(np.uint8)
        if not info.width or cells.size != info.width * info.height or info.resolution <= 0.0:
            self._node.get_logger().error(
                f'Ignored a map of {cells.size} cells instead of '
                f'{info.width} x {info.height} of {info.resolution:g} m.'
            )
            return
        origin = planar_pose(info.origin)
        if abs(origin.yaw) > 1e-3:
            self._node.get_logger().warning(
                f'The map is rotated by {math.degrees(origin.yaw):.1f} degrees; costmaps ignore '
                'the rotation.'
            )
        self._map = Costmap2D(
            info.width,
            info.height,
            # The message has single precision.
            round(float(info.resolution), 7),
            origin.x,
            origin.y,
            cells=self._table[cells.reshape(info.height, info.width)],
        )
        self._map_frame = message.header.frame_id
        self._changed = None
        self._node.get_logger().info(
            f"Layer '{self.name}': received a map of {info.width} x {info.height} cells of "
            f'{self._map.resolution:g} m'
        )
        self._node.take_map_size(self, self._map)
        self._node.touch()

    def _take_update(self, message: OccupancyGridUpdate) -> None:
        if self._map is None:
            return
        region = Region(
            message.x, message.y, message.x + message.width, message.y + message.height
        )
        cells = np.asarray(message.data, dtype=np.int8).view(np.uint8)
        if region.clipped(self._map) != region or cells.size != message.width * message.height:
            self._node.get_logger().error(
                f'Ignored an update of the map: {message.width} x {message.height} cells at '
                f'{message.x}, {message.y} are outside the map, or incomplete.'
            )
            return
        changed = self._table[cells.reshape(message.height, message.width)]
        self._map.cells[region.slices] = changed
        if self._is_same_place(self._node.grid):
            self._changed = region.union(self._changed)
        else:
            self._changed = Region.whole(self._node.grid)

    def _is_same_place(self, grid: Costmap2D) -> bool:
        """Whether the cells of the map coincide with those of the costmap."""
        return (
            self._map is not None
            and self._map_pose == (0.0, 0.0, 0.0)
            and self._map.cells.shape == grid.cells.shape
            and self._map.resolution == grid.resolution
            and (self._map.origin_x, self._map.origin_y) == (grid.origin_x, grid.origin_y)
        )

    def _follows_map_frame(self) -> bool:
        """Update the transform from the costmap's frame to the map's; return whether it moved."""
        if self._map_frame in ('', self._node.global_frame):
            return False
        try:
            pose = self._node.transforms.pose_of(self._node.global_frame, self._map_frame)
        except TransformError as error:
            self._node.get_logger().warning(
                f"Layer '{self.name}': {error}", throttle_duration_sec=_QUIET_S
            )
            return False
        is_moved, self._map_pose = pose != self._map_pose, pose
        return is_moved

    def _points_in_map(self, grid: Costmap2D, region: Region) -> FloatArray:
        """Compute the (rows, columns, 2) cell centres, in m in the frame of the map."""
        columns, rows = np.meshgrid(
            np.arange(region.x, region.x_end), np.arange(region.y, region.y_end)
        )
        points = grid.map_to_world_array(np.stack([columns, rows], axis=-1))
        return transformed(points, *self._map_pose)
