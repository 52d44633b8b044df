# SPDX-License-Identifier: Apache-2.0
"""Critics of DWB by cells: distances to the path and the goal, and costs of obstacles."""

from __future__ import annotations

import math

from dwb_critics.critic import Critic, illegal, invalid_costs, Scene
from dwb_plugins.generators import Floats
from nav2_controller.plugins import PluginContext
from nav2_costmap_2d.costs import LETHAL_OBSTACLE, NO_INFORMATION
from nav2_util.errors import ConfigurationError
import numpy as np
import numpy.typing as npt

__all__ = [
    'BaseObstacleCritic',
    'GoalAlignCritic',
    'GoalDistCritic',
    'ObstacleFootprintCritic',
    'PathAlignCritic',
    'PathDistCritic',
]

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


class BaseObstacleCritic(Critic):
    """
    Critic that scores the cost at the robot's centre; illegal where a circular robot collides.

    Parameters
    ----------
    context
        The name of the critic, which is the prefix of its parameters.

    """

    def __init__(self, context: PluginContext) -> None:
        super().__init__(context)
        self._sums = bool(
            context.value(
                'sum_scores', False, 'Whether all points count, and not only the last one.'
            )
        )

    def scores(self, scene: Scene) -> Floats:
        """
        Score the costs at the robot's centre along the trajectories.

        Parameters
        ----------
        scene
            The state and all trajectories of this period.

        Returns
        -------
        numpy.ndarray
            The last cost, or the sum of all with `sum_scores` (S,); infinite for trajectories with
            a point that is in collision for a circular robot, unknown, or off the costmap.

        """
        costs = scene.costs
        found = costs.sum(axis=1) if self._sums else costs[:, -1]
        return illegal(found.astype(np.float32), invalid_costs(costs).any(axis=1))

    def objection(self) -> str:
        """Describe why trajectories are illegal."""
        return 'hit an obstacle or leave the local costmap'


class ObstacleFootprintCritic(BaseObstacleCritic):
    """
    Critic that scores the cost at the robot's centre; illegal where the footprint collides.

    Parameters
    ----------
    context
        The name of the critic, which is the prefix of its parameters.

    """

    def __init__(self, context: PluginContext) -> None:
        super().__init__(context)
        context.unsupported(
            {
                'max_scaling_factor': 'the footprint keeps its size at any speed',
                'scaling_speed': 'the footprint keeps its size at any speed',
            }
        )

    def scores(self, scene: Scene) -> Floats:
        """
        Score the costs at the centre, and reject trajectories with a footprint collision.

        A circular robot is scored as by `BaseObstacleCritic`.

        Parameters
        ----------
        scene
            The state and all trajectories of this period.

        Returns
        -------
        numpy.ndarray
            The last cost, or the sum of all with `sum_scores` (S,); infinite for trajectories that
            hit an obstacle, or whose points are unknown or off the costmap.

        """
        surroundings = scene.state.surroundings
        if surroundings.is_circular:
            return super().scores(scene)
        rollouts = scene.rollouts
        found = scene.costs.astype(np.float32)
        wrong = (scene.costs == LETHAL_OBSTACLE) | (scene.costs == NO_INFORMATION)
        reach = float(np.hypot(*surroundings.footprint.T).max())
        clearance = scene.look_up(surroundings.clearance, rollouts.x, rollouts.y, 0.0)
        wrong |= clearance <= surroundings.inscribed_radius_m - surroundings.grid.resolution
        legal = ~wrong.any(axis=1)
        near = (clearance <= reach + 1.5 * surroundings.grid.resolution) & legal[:, None]
        at = np.nonzero(near)
        if len(at[0]):
            poses = np.stack(
                [rollouts.x[at], rollouts.y[at], rollouts.yaw[at]], axis=1, dtype=np.float64
            )
            wrong[at] |= surroundings.collisions(poses)
        total = found.sum(axis=1) if self._sums else found[:, -1]
        return illegal(total, wrong.any(axis=1))
