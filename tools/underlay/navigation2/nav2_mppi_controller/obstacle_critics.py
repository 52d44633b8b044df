# SPDX-License-Identifier: Apache-2.0
"""Critics of MPPI that keep trajectories away from obstacles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from nav2_controller.plugins import PluginContext
from nav2_costmap_2d.costs import (
    INSCRIBED_INFLATED_OBSTACLE,
    LETHAL_OBSTACLE,
    NO_INFORMATION,
)
from nav2_mppi_controller.critics import Critic, CriticParameters, powered
from nav2_mppi_controller.scene import Scene
from nav2_util.parameters import parameter, Unsupported
import numpy as np
import numpy.typing as npt

__all__ = ['CostCritic', 'ObstaclesCritic']

Floats = npt.NDArray[np.float32]

_UNSUPPORTED = {
    'inflation_layer_name': Unsupported('the costs of the local costmap count as they are', ('',))
}


@dataclass(frozen=True)
class CostParameters(CriticParameters):
    """The parameters of CostCritic."""

    cost_weight: float = parameter(3.81, 'The weight of its cost.')
    consider_footprint: bool = parameter(
        False, "Whether the robot's outline counts, and not only its centre."
    )
    collision_cost: float = parameter(1000000.0, 'What a collision costs.')
    critical_cost: float = parameter(300.0, 'What a near collision costs.')
    near_collision_cost: int = parameter(
        253, 'The cost of cells from which on a collision is near.', low=0, high=255
    )
    near_goal_distance: float = parameter(
        0.5, 'The distance in m from the goal within which only collisions count.'
    )
    trajectory_point_step: int = parameter(
        2, 'One in how many points of a trajectory counts.', low=1
    )


@dataclass(frozen=True)
class ObstaclesParameters(CriticParameters):
    """The parameters of ObstaclesCritic."""

    consider_footprint: bool = parameter(
        False, "Whether the robot's outline counts, and not only its centre."
    )
    critical_weight: float = parameter(20.0, 'The weight of being too near an obstacle.')
    repulsion_weight: float = parameter(1.5, 'The weight of being near one.')
    collision_cost: float = parameter(100000.0, 'What a collision costs.')
    collision_margin_distance: float = parameter(
        0.1, 'The distance in m from an obstacle that is too near.'
    )
    near_goal_distance: float = parameter(
        0.5, 'The distance in m from the goal within which being near does not count.'
    )
    inflation_radius: float = parameter(
        0.55, 'The inflation_radius of the local costmap in m.', low=0.0
    )
    cost_scaling_factor: float = parameter(
        10.0, 'The cost_scaling_factor of the local costmap.', low=0.1
    )


class CostCritic(Critic):
    """
    Critic of the costmap's costs along trajectories.

    Parameters
    ----------
    context
        As for `Critic`.

    """

    kind = CostParameters

    def __init__(self, context: PluginContext) -> None:
        super().__init__(context)
        context.unsupported(_UNSUPPORTED)

    def _costs(self, scene: Scene, p: Any) -> Floats | None:
        step = p.trajectory_point_step
        costs = scene.costs(step)
        outline = p.consider_footprint and not scene.state.surroundings.is_circular
        collides = _colliding(scene, costs, step, outline)
        scene.collides |= collides.any(axis=1)
        known = np.where(costs == NO_INFORMATION, np.float32(0.0), costs.astype(np.float32))
        if scene.goal_distance_m <= p.near_goal_distance:
            known[:] = 0.0
        near = (costs >= p.near_collision_cost) & (costs != NO_INFORMATION)
        each = np.where(near, np.float32(p.critical_cost), known).mean(axis=1)
        found = np.where(scene.collides, np.float32(p.collision_cost), each)
        return powered(found, p, p.cost_weight / 254.0)


class ObstaclesCritic(Critic):
    """
    Critic of the distance to obstacles along trajectories, derived from the costs.

    Parameters
    ----------
    context
        As for `Critic`.

    """

    kind = ObstaclesParameters

    def __init__(self, context: PluginContext) -> None:
        super().__init__(context)
        context.unsupported(_UNSUPPORTED)

    def _costs(self, scene: Scene, p: Any) -> Floats | None:
        costs = scene.costs(1)
        outline = p.consider_footprint and not scene.state.surroundings.is_circular
        collides = _colliding(scene, costs, 1, outline)
        scene.collides |= collides.any(axis=1)
        radius = scene.state.surroundings.inscribed_radius_m
        table = np.full(256, p.inflation_radius - radius, np.float32)
        inflated = np.arange(1, INSCRIBED_INFLATED_OBSTACLE)
        away = np.log(252.0 / inflated) / p.cost_scaling_factor
        table[1:INSCRIBED_INFLATED_OBSTACLE] = np.minimum(away, table[0])
        table[slice(INSCRIBED_INFLATED_OBSTACLE, LETHAL_OBSTACLE + 1)] = 0.0
        distance = table[costs]
        margin = np.float32(p.collision_margin_distance)
        critical = np.maximum(margin - distance, 0.0).mean(axis=1)
        found = powered(critical, p, p.critical_weight)
        if scene.goal_distance_m > p.near_goal_distance:
            repulsion = np.maximum(table[0] - distance, 0.0).mean(axis=1)
            found = found + powered(repulsion, p, p.repulsion_weight)
        return np.where(scene.collides, np.float32(p.collision_cost), found)


def _colliding(
    scene: Scene, costs: npt.NDArray[np.uint8], step: int, outline: bool
) -> npt.NDArray[np.bool_]:
    """Find the points of trajectories at which the robot is in collision."""
    if not outline:
        hits: npt.NDArray[np.bool_] = (costs >= INSCRIBED_INFLATED_OBSTACLE) & (
            costs != NO_INFORMATION
        )
        return hits
    hits = costs == LETHAL_OBSTACLE
    trajectories = scene.trajectories
    # The footprint can only touch an obstacle where costs are inflated.
    at = np.nonzero((costs > 0) & (costs != NO_INFORMATION) & ~hits)
    if len(at[0]):
        columns = at[1] * step
        poses = np.stack(
            [
                trajectories.x[at[0], columns],
                trajectories.y[at[0], columns],
                trajectories.yaw[at[0], columns],
            ],
            axis=1,
            dtype=np.float64,
        )
        hits[at] = scene.state.surroundings.collisions(poses)
    return hits
