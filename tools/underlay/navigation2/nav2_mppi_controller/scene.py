# SPDX-License-Identifier: Apache-2.0
"""The input of the MPPI critics: trajectories, the path and the costmap of one period."""

from __future__ import annotations

from functools import cached_property

from nav2_controller.control import ControlState
from nav2_controller.tracking import path_lengths
from nav2_costmap_2d.costs import (
    INSCRIBED_INFLATED_OBSTACLE,
    LETHAL_OBSTACLE,
    NO_INFORMATION,
)
from nav2_mppi_controller.motion import Trajectories
from nav2_mppi_controller.parameters import MppiParameters
import numpy as np
import numpy.typing as npt

__all__ = ['Scene']

Floats = npt.NDArray[np.float32]


class Scene:
    """
    Input of the critics in one optimization iteration.

    Parameters
    ----------
    state
        The robot, its path and the costmap in this control period.
    trajectories
        The candidate trajectories.
    settings
        The settings of the controller.

    """

    def __init__(
        self, state: ControlState, trajectories: Trajectories, settings: MppiParameters
    ) -> None:
        self.state, self.trajectories, self.settings = state, trajectories, settings
        self.path = state.plan.astype(np.float32)
        """(N, 3) poses of the path ahead."""
        self.collides: npt.NDArray[np.bool_] = np.zeros(len(trajectories.x), bool)
        """(K,) mask of the trajectories in collision; set by the obstacle critics."""

    @cached_property
    def goal_distance_m(self) -> float:
        """Compute the distance from the robot to the end of its path, if that is the goal."""
        return self.state.goal_distance_m if self.state.is_goal_in_plan else np.inf

    @cached_property
    def path_lengths(self) -> Floats:
        """(N,) arc lengths along the path in m."""
        return path_lengths(self.state.plan).astype(np.float32)

    @cached_property
    def furthest(self) -> int:
        """Find the pose of the path nearest to the end of the trajectory that reaches furthest."""
        x, y = self.trajectories.x[:, -1:], self.trajectories.y[:, -1:]
        squared = (x - self.path[:, 0]) ** 2 + (y - self.path[:, 1]) ** 2
        return int(np.argmin(squared, axis=1).max())

    @cached_property
    def path_blocked(self) -> npt.NDArray[np.bool_]:
        """(N,) mask of the poses of the path that are blocked by obstacles."""
        costs = self.state.surroundings.grid.costs_at(self.path[:, :2], outside=NO_INFORMATION)
        blocked: npt.NDArray[np.bool_] = (costs >= INSCRIBED_INFLATED_OBSTACLE) & (
            costs <= LETHAL_OBSTACLE
        )
        return blocked

    def first_free(self, index: int) -> int:
        """
        Find the first pose of the path, from an index on, that is not blocked.

        Parameters
        ----------
        index
            The pose to start with; beyond the end of the path, it is the last one.

        Returns
        -------
        int
            The index in `path`; that of the last pose if all are blocked.

        """
        index = min(index, len(self.path) - 1)
        free = np.flatnonzero(~self.path_blocked[index:])
        return index + int(free[0]) if len(free) else len(self.path) - 1

    def costs(self, step: int) -> npt.NDArray[np.uint8]:
        """
        Look up the costs of the costmap along the trajectories.

        Parameters
        ----------
        step
            The stride over the points of a trajectory.

        Returns
        -------
        numpy.ndarray
            (K, ceil(T / step)) costs from 0 to 255; 255 off the costmap.

        """
        grid = self.state.surroundings.grid
        scale = np.float32(1.0 / grid.resolution)
        u = (self.trajectories.x[:, ::step] - np.float32(grid.origin_x)) * scale
        v = (self.trajectories.y[:, ::step] - np.float32(grid.origin_y)) * scale
        # A border of unknown cells stands for the outside.
        np.clip(u, -1.0, grid.size_x, out=u)
        np.clip(v, -1.0, grid.size_y, out=v)
        u += np.float32(1.0)
        v += np.float32(1.0)
        index = v.astype(np.int32) * np.int32(grid.size_x + 2) + u.astype(np.int32)
        found: npt.NDArray[np.uint8] = self._bordered.ravel()[index]
        return found

    @cached_property
    def _bordered(self) -> npt.NDArray[np.uint8]:
        cells = self.state.surroundings.grid.cells
        return np.pad(cells, 1, constant_values=NO_INFORMATION)
