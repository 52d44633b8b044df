# SPDX-License-Identifier: Apache-2.0
"""What the critics of DWB share: the scene that they score, and their scale."""

from __future__ import annotations

from functools import cached_property
import math
from typing import Any

import cv2
from dwb_plugins.generators import Floats, Rollouts
from nav2_controller.control import ControlState, Velocity
from nav2_controller.plugins import PluginContext
from nav2_costmap_2d.costs import (
    INSCRIBED_INFLATED_OBSTACLE,
    NO_INFORMATION,
)
import numpy as np
import numpy.typing as npt

__all__ = ['Critic', 'Scene', 'invalid_costs']

FloatArray = npt.NDArray[np.float64]


def invalid_costs(costs: npt.NDArray[np.uint8]) -> npt.NDArray[np.bool_]:
    """
    Find the costs at which the robot's centre collides or may collide.

    Parameters
    ----------
    costs
        Costs of a costmap, of any shape.

    Returns
    -------
    numpy.ndarray
        Of the same shape: True from INSCRIBED_INFLATED_OBSTACLE on, also for NO_INFORMATION.

    """
    invalid: npt.NDArray[np.bool_] = np.greater_equal(costs, INSCRIBED_INFLATED_OBSTACLE)
    return invalid


class Scene:
    """
    State and trajectories of one control period, with the quantities that several critics use.

    Parameters
    ----------
    state
        The state of the robot, its path and the costmap.
    rollouts
        The trajectories.

    """

    def __init__(self, state: ControlState, rollouts: Rollouts) -> None:
        self.state, self.rollouts = state, rollouts

    @cached_property
    def costs(self) -> npt.NDArray[np.uint8]:
        """(S, T) costs at the points of the trajectories; NO_INFORMATION off the costmap."""
        return self.costs_at(self.rollouts.x, self.rollouts.y)

    def costs_at(self, x: Floats, y: Floats) -> npt.NDArray[np.uint8]:
        """
        Look up the costs at points.

        Parameters
        ----------
        x, y
            Positions in m in the frame of the costmap, both of the same shape.

        Returns
        -------
        numpy.ndarray
            Costs of that shape; NO_INFORMATION off the costmap.

        """
        costs: npt.NDArray[np.uint8] = self.look_up(
            self.state.surroundings.grid.cells, x, y, NO_INFORMATION
        )
        return costs

    def look_up(
        self, values: npt.NDArray[Any], x: Floats, y: Floats, outside: float
    ) -> npt.NDArray[Any]:
        """
        Look up values of costmap cells at points.

        Parameters
        ----------
        values
            One value for each cell of the costmap (rows, columns).
        x, y
            Positions in m in the frame of the costmap, both of the same shape.
        outside
            The value of points off the costmap.

        Returns
        -------
        numpy.ndarray
            Values of the shape of the positions.

        """
        grid = self.state.surroundings.grid
        scale = np.float32(1.0 / grid.resolution)
        u = np.floor((x - np.float32(grid.origin_x)) * scale).astype(np.int32)
        v = np.floor((y - np.float32(grid.origin_y)) * scale).astype(np.int32)
        beyond = (u < 0) | (v < 0) | (u >= grid.size_x) | (v >= grid.size_y)
        if beyond.any():
            u, v = np.where(beyond, 0, u), np.where(beyond, 0, v)
        found: npt.NDArray[Any] = values.ravel()[v * grid.size_x + u]
        return np.where(beyond, values.dtype.type(outside), found) if beyond.any() else found

    @cached_property
    def path_distances(self) -> Floats:
        """Compute the distance in cells from each cell of the costmap to the path."""
        return self.distances_to(self.state.plan)

    def distances_to(self, plan: FloatArray) -> Floats:
        """
        Compute the distance transform of a path over the costmap.

        Parameters
        ----------
        plan
            Points (N, 2 or more), x and y first, in m in the frame of the costmap.

        Returns
        -------
        numpy.ndarray
            Distance in cells from each cell (rows, columns) to the nearest one with a point. If no
            point is on the costmap, the number of cells along its longer side.

        """
        grid = self.state.surroundings.grid
        away = np.ones(grid.cells.shape, np.uint8)
        columns, rows = grid.world_to_map_array(plan[:, :2]).T
        inside = (columns >= 0) & (rows >= 0) & (columns < grid.size_x) & (rows < grid.size_y)
        if not inside.any():
            return np.full(away.shape, float(max(away.shape)), np.float32)
        away[rows[inside], columns[inside]] = 0
        return np.asarray(cv2.distanceTransform(away, cv2.DIST_L2, 5), np.float32)

    @property
    def local_goal(self) -> FloatArray:
        """Return the last pose of the path that is within the costmap."""
        goal: FloatArray = self.state.plan[-1]
        return goal


class Critic:
    """
    Base class of critics, which score all trajectories at once.

    Parameters
    ----------
    context
        Its name is that of the critic below that of the controller.

    """

    default_scale = 1.0

    def __init__(self, context: PluginContext) -> None:
        self.name = context.name.rpartition('.')[2]
        scale = context.value('scale', self.default_scale, 'How much the critic counts.')
        self._scale = float(scale)

    def reset(self) -> None:
        """Reset the state for a new goal."""

    def begin(self, scene: Scene) -> None:
        """
        Prepare for one control period; called before `scale` and `scores`.

        Parameters
        ----------
        scene
            The state and all trajectories of this period.

        """

    def scale(self, scene: Scene) -> float:
        """
        Return the weight of the scores; where it is 0, `scores` is not called.

        Parameters
        ----------
        scene
            The state and all trajectories of this period.

        """
        return self._scale

    def scores(self, scene: Scene) -> Floats:
        """
        Score all trajectories; lower is better.

        Parameters
        ----------
        scene
            The state and all trajectories of this period.

        Returns
        -------
        numpy.ndarray
            One score for each of the S trajectories (S,); infinite for one that is illegal.

        """
        raise NotImplementedError

    def objection(self) -> str:
        """Describe why trajectories are illegal, as the end of a sentence."""
        return 'are refused'

    def debrief(self, velocity: Velocity) -> None:
        """
        Record the chosen velocity; called once per control period that has a valid one.

        Parameters
        ----------
        velocity
            The velocity in the base frame.

        """


def illegal(scores: Floats, mask: Any) -> Floats:
    """
    Make the scores of illegal trajectories infinite.

    Parameters
    ----------
    scores
        One score for each trajectory (S,).
    mask
        Mask of the illegal trajectories (S,).

    Returns
    -------
    numpy.ndarray
        A new array (S,).

    """
    return np.where(mask, np.float32(math.inf), scores)
