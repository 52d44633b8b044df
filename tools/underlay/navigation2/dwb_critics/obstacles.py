# SPDX-License-Identifier: Apache-2.0
"""Critics of DWB that keep the robot away from obstacles."""

from __future__ import annotations

from dwb_critics.critic import Critic, illegal, invalid_costs, Scene
from dwb_plugins.generators import Floats
from nav2_controller.plugins import PluginContext
from nav2_costmap_2d.costs import LETHAL_OBSTACLE, NO_INFORMATION
import numpy as np

__all__ = ['BaseObstacleCritic', 'ObstacleFootprintCritic']


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
