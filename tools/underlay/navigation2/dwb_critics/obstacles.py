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
    """Scores the cost at the robot's centre; illegal where a circular robot would collide."""

    def __init__(self, context: PluginContext) -> None:
        super().__init__(context)
        self._sums = bool(
            context.value(
                'sum_scores', False, 'Whether all points count, and not only the last one.'
            )
        )

    def scores(self, scene: Scene) -> Floats:
        """Return (S,) scores; infinite for trajectories that are illegal."""
        costs = scene.costs
        found = costs.sum(axis=1) if self._sums else costs[:, -1]
        return illegal(found.astype(np.float32), invalid_costs(costs).any(axis=1))

    def objection(self) -> str:
        """Return why trajectories are illegal."""
        return 'hit an obstacle or leave the local costmap'


class ObstacleFootprintCritic(BaseObstacleCritic):
    """Scores the highest cost on the robot's outline; illegal where it is on an obstacle."""

    def __init__(self, context: PluginContext) -> None:
        super().__init__(context)
        context.unsupported(
            {
                'max_scaling_factor': 'the footprint keeps its size at any speed',
                'scaling_speed': 'the footprint keeps its size at any speed',
            }
        )

    def scores(self, scene: Scene) -> Floats:
        """Return (S,) scores; infinite for trajectories that are illegal."""
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
