# SPDX-License-Identifier: Apache-2.0
"""Critics of DWB that align the robot with the path and the goal, by distances in cells."""

from __future__ import annotations

import math

from dwb_critics.critic import Critic, Scene
from dwb_plugins.generators import Floats
from nav2_controller.plugins import PluginContext
from nav2_costmap_2d.costs import LETHAL_OBSTACLE
from nav2_util.errors import ConfigurationError
import numpy as np
import numpy.typing as npt

__all__ = ['GoalAlignCritic', 'GoalDistCritic', 'PathAlignCritic', 'PathDistCritic']

_AGGREGATIONS = ('last', 'sum', 'product')


class _MapGridCritic(Critic):
    """Scores a distance at the last point, or at all points, of trajectories."""

    forward_m = 0.0
    """How far the scored point is ahead of the robot's centre."""

    def __init__(self, context: PluginContext) -> None:
        super().__init__(context)
        self._aggregation = str(
            context.value(
                'aggregation_type', 'last', f'One of {", ".join(_AGGREGATIONS)}: what counts.'
            )
        )
        if self._aggregation not in _AGGREGATIONS:
            raise ConfigurationError(
                f"The parameter '{context.name}.aggregation_type' must be one of "
                f"'last', 'sum', 'product', but is '{self._aggregation}'."
            )

    def scale(self, scene: Scene) -> float:
        """Return the factor of the scores."""
        return 0.5 * scene.state.surroundings.grid.resolution * self._scale

    def scores(self, scene: Scene) -> Floats:
        """Compute (S,) scores; infinite for illegal trajectories."""
        rollouts = scene.rollouts
        part = slice(-1, None) if self._aggregation == 'last' else slice(None)
        x, y = rollouts.x[:, part], rollouts.y[:, part]
        if self.forward_m:
            yaw = rollouts.yaw[:, part]
            x = x + np.float32(self.forward_m) * np.cos(yaw)
            y = y + np.float32(self.forward_m) * np.sin(yaw)
        found = self._distances(scene, x, y)
        if self._aggregation == 'product':
            return np.asarray(found.prod(axis=1), np.float32)
        return np.asarray(found.sum(axis=1), np.float32)

    def _distances(self, scene: Scene, x: Floats, y: Floats) -> Floats:
        raise NotImplementedError


class PathDistCritic(_MapGridCritic):
    """Critic that scores the distance between the ends of trajectories and the path."""

    default_scale = 1.0

    def _distances(self, scene: Scene, x: Floats, y: Floats) -> Floats:
        grid = scene.state.surroundings.grid
        found = scene.look_up(scene.path_distances, x, y, float(grid.size_x + grid.size_y))
        if self.forward_m:
            return np.asarray(found, np.float32)
        # A trajectory that ends in an obstacle counts as far from the path.
        blocked = scene.look_up(grid.cells, x, y, LETHAL_OBSTACLE) == LETHAL_OBSTACLE
        return np.where(blocked, np.float32(grid.size_x * grid.size_y), found)


class GoalDistCritic(_MapGridCritic):
    """Critic that scores the distance between the ends of trajectories and the local goal."""

    def _goal(self, scene: Scene) -> npt.NDArray[np.float64]:
        return scene.local_goal

    def _distances(self, scene: Scene, x: Floats, y: Floats) -> Floats:
        goal, resolution = self._goal(scene), scene.state.surroundings.grid.resolution
        found = np.hypot(x - np.float32(goal[0]), y - np.float32(goal[1]))
        return np.asarray(found / np.float32(resolution), np.float32)


class PathAlignCritic(PathDistCritic):
    """
    Critic that aligns the robot with the path: scores the path distance of a point ahead of it.

    Parameters
    ----------
    context
        The name of the critic, which is the prefix of its parameters.

    Raises
    ------
    ConfigurationError
        `aggregation_type` is not last, sum or product.

    """

    def __init__(self, context: PluginContext) -> None:
        super().__init__(context)
        self.forward_m = _forward_distance(context)
        self._is_near_goal = False

    def begin(self, scene: Scene) -> None:
        """
        Check whether the end of the local path is too close for the robot to align with the path.

        Parameters
        ----------
        scene
            The state and all trajectories of this period.

        """
        x, y = scene.local_goal[:2]
        pose = scene.state.pose
        self._is_near_goal = math.hypot(pose.x - x, pose.y - y) <= self.forward_m

    def scale(self, scene: Scene) -> float:
        """
        Return the weight of the scores: 0 within `forward_point_distance` of the end of the path.

        Parameters
        ----------
        scene
            The state and all trajectories of this period.

        """
        return 0.0 if self._is_near_goal else super().scale(scene)


class GoalAlignCritic(GoalDistCritic):
    """
    Critic that scores the distance between a point ahead of the robot and one beyond the goal.

    Parameters
    ----------
    context
        The name of the critic, which is the prefix of its parameters.

    Raises
    ------
    ConfigurationError
        `aggregation_type` is not last, sum or product.

    """

    def __init__(self, context: PluginContext) -> None:
        super().__init__(context)
        self.forward_m = _forward_distance(context)

    def _goal(self, scene: Scene) -> npt.NDArray[np.float64]:
        pose = scene.state.pose
        goal: npt.NDArray[np.float64] = scene.local_goal.copy()
        heading = math.atan2(goal[1] - pose.y, goal[0] - pose.x)
        goal[0] += self.forward_m * math.cos(heading)
        goal[1] += self.forward_m * math.sin(heading)
        return goal


def _forward_distance(context: PluginContext) -> float:
    return float(
        context.value(
            'forward_point_distance', 0.325, 'How far in m ahead of the robot the point is.'
        )
    )
