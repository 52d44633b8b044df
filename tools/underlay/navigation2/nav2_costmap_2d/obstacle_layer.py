# SPDX-License-Identifier: Apache-2.0
"""The layers that mark obstacles seen by sensors, and clear free space by raytracing."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TYPE_CHECKING

from nav2_costmap_2d.costs import FREE_SPACE, NO_INFORMATION
from nav2_costmap_2d.footprint import fill_polygon, transformed
from nav2_costmap_2d.grid import CellArray, Costmap2D
from nav2_costmap_2d.layers import Layer
from nav2_costmap_2d.observation_source import ObservationSource
from nav2_costmap_2d.raytracing import clear_rays, mark_points
from nav2_costmap_2d.regions import forget_cells, Region, write_maximum, write_over
from nav2_util.geometry import Pose2D
from nav2_util.parameters import parameter, Unsupported
import numpy as np

if TYPE_CHECKING:
    from nav2_costmap_2d.costmap_node import Costmap2DROS

__all__ = ['ObstacleLayer', 'ObstacleParameters', 'VoxelLayer', 'VoxelParameters']

_OVERWRITE, _MAXIMUM, _MAXIMUM_OF_KNOWN = 0, 1, 2


@dataclass(frozen=True)
class ObstacleParameters:
    """The parameters of `nav2_costmap_2d::ObstacleLayer`, besides those of its sources."""

    enabled: bool = parameter(True, 'Whether the layer takes part.')
    footprint_clearing_enabled: bool = parameter(
        True, 'Whether the cells below the robot are free.'
    )
    min_obstacle_height: float = parameter(0.0, 'Lower points do not mark, in m.')
    max_obstacle_height: float = parameter(2.0, 'Higher points do not mark, in m.')
    combination_method: int = parameter(
        1,
        'How it joins the layers below: 0 replaces their costs, 1 raises them, 2 raises them '
        'where they are known.',
        low=_OVERWRITE,
        high=_MAXIMUM_OF_KNOWN,
    )
    observation_sources: str = parameter('', 'The names of its sources, separated by spaces.')


@dataclass(frozen=True)
class VoxelParameters(ObstacleParameters):
    """The parameters of `nav2_costmap_2d::VoxelLayer`, besides those of its sources."""

    z_voxels: int = parameter(10, 'The number of voxels in a column.', low=0, high=16)
    origin_z: float = parameter(0.0, 'The height of the lowest voxel in m.')
    z_resolution: float = parameter(0.2, 'The height of a voxel in m.', low=0.001)
    mark_threshold: int = parameter(
        0, 'A column with more occupied voxels than this is an obstacle.', low=0, high=16
    )


class ObstacleLayer(Layer):
    """
    Layer that keeps the obstacles seen by sensors until they are cleared by raytracing.

    Parameters
    ----------
    node
        The costmap's node.
    name
        The name of the layer.

    """

    is_clearable = True
    parameters_kind: Any = ObstacleParameters

    def __init__(self, node: Costmap2DROS, name: str) -> None:
        super().__init__(name)
        self._node = node
        self._settings = node.parameters.declare(self.parameters_kind, name)
        self._settings.on_change = lambda _: node.touch()
        node.parameters.declare_unsupported(
            {
                'tf_filter_tolerance': Unsupported(
                    'messages wait until the pose of their sensor is known', (0.05,)
                )
            },
            name,
        )
        self._default = NO_INFORMATION if node.tracks_unknown else FREE_SPACE
        self._grid = node.grid
        self._robot: Pose2D | None = None
        self._is_stale = True
        self._sources = [
            ObservationSource(node, name, each)
            for each in self._settings.current.observation_sources.split()
        ]

    @property
    def is_enabled(self) -> bool:
        """Whether the layer is enabled."""
        return bool(self._settings.current.enabled)

    @property
    def is_current(self) -> bool:
        """Whether all sensors publish at the expected rate."""
        return all(source.is_current for source in self._sources)

    def match(self, grid: Costmap2D) -> None:
        """
        Shift the observed cells with the costmap; a costmap of another size starts empty.

        Parameters
        ----------
        grid
            As for `Layer.match`.

        """
        old = self._grid
        if old.cells.shape == grid.cells.shape and old.resolution == grid.resolution:
            dx = round((grid.origin_x - old.origin_x) / grid.resolution)
            dy = round((grid.origin_y - old.origin_y) / grid.resolution)
            self._grid = old.shifted(dx, dy, self._default)
            # Whole cells from one origin, so that rounding errors do not accumulate.
            self._grid.origin_x, self._grid.origin_y = grid.origin_x, grid.origin_y
        else:
            self._grid = grid.with_cells(np.full_like(grid.cells, self._default))
        self._is_stale = True

    def clear(self, region: Region | None, *, is_inverted: bool = False) -> None:
        """
        Clear the observed cells; the newest messages are applied again with the next update.

        Parameters
        ----------
        region, is_inverted
            As for `Layer.clear`.

        """
        if region is None:
            self._grid.cells[...] = self._default
        else:
            forget_cells(self._grid, region, is_inverted)
        self._is_stale = True

    def update(self, grid: Costmap2D, robot: Pose2D | None) -> Region | None:
        """
        Process the newest messages, and clear the cells under the footprint.

        Parameters
        ----------
        grid, robot
            As for `Layer.update`.

        Returns
        -------
        Region or None
            The cells that have changed; None if there are none.

        """
        refreshed = [source.refresh() for source in self._sources]
        is_new = any(refreshed) or self._is_stale
        if not is_new and (robot is None or robot == self._robot):
            return None
        before = self._grid.cells.copy()
        if is_new:
            self._observe()
        self._is_stale, self._robot = False, robot
        if robot is not None and self._settings.current.footprint_clearing_enabled:
            outline = transformed(self._node.footprint, *robot)
            self._grid.cells[fill_polygon(self._grid, outline)] = FREE_SPACE
        return Region.of_mask(before != self._grid.cells)

    def apply(self, grid: Costmap2D, region: Region) -> None:
        """
        Combine the observed cells with the layers below by `combination_method`, in place.

        Parameters
        ----------
        grid, region
            As for `Layer.apply`.

        """
        cells: CellArray = grid.cells[region.slices]
        seen = self._grid.cells[region.slices]
        method = self._settings.current.combination_method
        if method == _OVERWRITE:
            write_over(cells, seen)
        else:
            write_maximum(cells, seen, keep_unknown=method == _MAXIMUM_OF_KNOWN)

    def costs(self, grid: Costmap2D) -> Costmap2D:
        """
        Return the costs of the observed cells; later updates modify the same grid.

        Parameters
        ----------
        grid
            Not used: the layer keeps a grid of the same size.

        """
        return self._grid

    def _observe(self) -> None:
        for source in self._sources:
            values = source.settings
            if values.clearing:
                for each in source.observations:
                    clear_rays(
                        self._grid, each, values.raytrace_min_range, values.raytrace_max_range
                    )
        heights, threshold = self._heights(), self._threshold()
        for source in self._sources:
            values = source.settings
            if values.marking:
                nearest, farthest = values.obstacle_min_range, values.obstacle_max_range
                for each in source.observations:
                    mark_points(self._grid, each, nearest, farthest, heights, threshold)

    def _heights(self) -> tuple[float, float]:
        """Return the height limits for marking, in m."""
        values = self._settings.current
        return values.min_obstacle_height, values.max_obstacle_height

    def _threshold(self) -> int:
        """Return the number of points that a cell must exceed to be marked."""
        return 0


class VoxelLayer(ObstacleLayer):
    """
    Obstacle layer with the height limits of a voxel grid.

    The voxels themselves are not stored: rays clear whole columns, and `mark_threshold` applies to
    the points of a message in a column.

    Parameters
    ----------
    node, name
        As for `ObstacleLayer`.

    """

    parameters_kind = VoxelParameters

    def __init__(self, node: Costmap2DROS, name: str) -> None:
        super().__init__(node, name)
        node.parameters.declare_unsupported(
            {
                'publish_voxel_map': Unsupported(
                    "the layer keeps columns and no voxels, so that 'voxel_grid' is not published",
                    (False,),
                ),
                'unknown_threshold': Unsupported(
                    'a column is known as soon as a ray crosses it', (15,)
                ),
            },
            name,
        )

    def _heights(self) -> tuple[float, float]:
        values: VoxelParameters = self._settings.current
        top = values.origin_z + values.z_voxels * values.z_resolution
        lowest, highest = super()._heights()
        return max(lowest, values.origin_z), min(highest, top)

    def _threshold(self) -> int:
        values: VoxelParameters = self._settings.current
        return values.mark_threshold
