# SPDX-License-Identifier: Apache-2.0
"""Critics of MPPI for the goal and the motion constraints, and what all critics share."""

from __future__ import annotations

from dataclasses import dataclass
import math
from typing import Any

from nav2_controller.plugins import PluginContext
from nav2_mppi_controller.scene import Scene
from nav2_util.parameters import parameter
import numpy as np
import numpy.typing as npt

__all__ = [
    'ConstraintCritic',
    'Critic',
    'CriticParameters',
    'GoalAngleCritic',
    'GoalCritic',
    'PreferForwardCritic',
    'TwirlingCritic',
    'VelocityDeadbandCritic',
    'angle_magnitudes',
    'powered',
]

Floats = npt.NDArray[np.float32]


@dataclass(frozen=True)
class CriticParameters:
    """Parameters that all critics have."""

    enabled: bool = parameter(True, 'Whether the critic is asked.')
    cost_power: int = parameter(1, 'The power of its cost.', low=1)
    cost_weight: float = parameter(4.0, 'The weight of its cost.')


@dataclass(frozen=True)
class GoalParameters(CriticParameters):
    """The parameters of GoalCritic."""

    cost_weight: float = parameter(5.0, 'The weight of its cost.')
    threshold_to_consider: float = parameter(
        1.4, 'The distance in m from the goal within which the critic is asked.'
    )


@dataclass(frozen=True)
class GoalAngleParameters(CriticParameters):
    """The parameters of GoalAngleCritic."""

    cost_weight: float = parameter(3.0, 'The weight of its cost.')
    threshold_to_consider: float = parameter(
        0.5, 'The distance in m from the goal within which the critic is asked.'
    )


@dataclass(frozen=True)
class PreferForwardParameters(CriticParameters):
    """The parameters of PreferForwardCritic."""

    cost_weight: float = parameter(5.0, 'The weight of its cost.')
    threshold_to_consider: float = parameter(
        0.5, 'The distance in m from the goal beyond which the critic is asked.'
    )


@dataclass(frozen=True)
class TwirlingParameters(CriticParameters):
    """The parameters of TwirlingCritic."""

    cost_weight: float = parameter(10.0, 'The weight of its cost.')


@dataclass(frozen=True)
class DeadbandParameters(CriticParameters):
    """The parameters of VelocityDeadbandCritic."""

    cost_weight: float = parameter(35.0, 'The weight of its cost.')
    deadband_velocities: list[float] = parameter(
        [0.0, 0.0, 0.0], 'Magnitudes of vx, vy (m/s) and wz (rad/s) below which it does not move.'
    )


def powered(cost: Floats, parameters: CriticParameters, weight: float | None = None) -> Floats:
    """
    Weight the cost of a critic, and raise it to the critic's power.

    Parameters
    ----------
    cost
        (K,) cost of each trajectory, in the unit of the critic.
    parameters : CriticParameters
        The parameters of the critic.
    weight
        A weight that replaces `cost_weight`.

    Returns
    -------
    Floats
        (K,) cost of each trajectory: (weight * cost) ** `cost_power`.

    """
    weighted: Floats = cost * np.float32(parameters.cost_weight if weight is None else weight)
    if parameters.cost_power != 1:
        weighted = np.power(weighted, parameters.cost_power)
    return weighted


def angle_magnitudes(angles: Floats) -> Floats:
    """
    Compute the magnitudes of angles.

    Parameters
    ----------
    angles
        The angles in rad.

    Returns
    -------
    Floats
        Their magnitudes, from 0 to pi.

    """
    turns: Floats = angles * np.float32(0.5 / math.pi)
    turns -= np.rint(turns)
    return np.asarray(np.abs(turns) * np.float32(2.0 * math.pi), np.float32)


class Critic:
    """
    Base class of critics, which compute the cost of each trajectory.

    Subclasses override `_costs`, and set `kind` to the dataclass of their parameters.

    Parameters
    ----------
    context
        The name of the critic, such as FollowPath.GoalCritic, and the source of its parameters.

    """

    kind: type[Any] = CriticParameters

    def __init__(self, context: PluginContext) -> None:
        self._set = context.declare(self.kind)

    def costs(self, scene: Scene) -> Floats | None:
        """
        Score the trajectories of one optimization iteration.

        Parameters
        ----------
        scene
            The trajectories, the path and the costmap.

        Returns
        -------
        Floats or None
            (K,) costs; None if the critic is disabled, or does not apply now.

        """
        current = self._set.current
        return self._costs(scene, current) if current.enabled else None

    def _costs(self, scene: Scene, p: Any) -> Floats | None:
        raise NotImplementedError


class ConstraintCritic(Critic):
    """Critic of velocities beyond the limits."""

    def _costs(self, scene: Scene, p: Any) -> Floats | None:
        limits = scene.settings
        vx, vy, wz = scene.trajectories.velocities
        if limits.motion_model == 'Omni':
            speed = np.sign(vx) * np.hypot(vx, vy)
            highest = math.hypot(limits.vx_max, limits.vy_max)
            lowest = -math.hypot(limits.vx_min, limits.vy_max)
        else:
            speed, highest, lowest = vx, limits.vx_max, limits.vx_min
        beyond = np.maximum(speed - np.float32(highest), 0.0)
        beyond += np.maximum(np.float32(lowest) - speed, 0.0)
        if limits.motion_model == 'Ackermann':
            tight = np.float32(limits.min_turning_r) * np.abs(wz) - np.abs(vx)
            beyond += np.maximum(tight, 0.0)
        if not beyond.any():
            return None
        return powered(beyond.sum(axis=1) * np.float32(limits.model_dt), p)


class GoalCritic(Critic):
    """Critic of the distance to the goal, near the goal."""

    kind = GoalParameters

    def _costs(self, scene: Scene, p: Any) -> Floats | None:
        if scene.goal_distance_m > p.threshold_to_consider:
            return None
        goal, trajectories = scene.state.goal, scene.trajectories
        away = np.hypot(trajectories.x - np.float32(goal.x), trajectories.y - np.float32(goal.y))
        return powered(away.mean(axis=1), p)


class GoalAngleCritic(Critic):
    """Critic of the heading error to the goal, near the goal."""

    kind = GoalAngleParameters

    def _costs(self, scene: Scene, p: Any) -> Floats | None:
        if scene.goal_distance_m > p.threshold_to_consider:
            return None
        turn = scene.trajectories.yaw - np.float32(scene.state.goal.yaw)
        return powered(angle_magnitudes(turn).mean(axis=1), p)


class PreferForwardCritic(Critic):
    """Critic that penalises driving backward."""

    kind = PreferForwardParameters

    def _costs(self, scene: Scene, p: Any) -> Floats | None:
        if scene.goal_distance_m < p.threshold_to_consider:
            return None
        back = np.maximum(-scene.trajectories.velocities[0], 0.0).sum(axis=1)
        return powered(back * np.float32(scene.settings.model_dt), p)


class TwirlingCritic(Critic):
    """Critic that penalises rotation."""

    kind = TwirlingParameters

    def _costs(self, scene: Scene, p: Any) -> Floats | None:
        if scene.goal_distance_m < scene.state.xy_tolerance_m:
            return None
        return powered(np.abs(scene.trajectories.velocities[2]).mean(axis=1), p)


class VelocityDeadbandCritic(Critic):
    """Critic of velocities in the deadband of the robot."""

    kind = DeadbandParameters

    def _costs(self, scene: Scene, p: Any) -> Floats | None:
        total: Floats | None = None
        for velocity, deadband in zip(scene.trajectories.velocities, p.deadband_velocities):
            if deadband > 0.0:
                short = np.maximum(np.float32(deadband) - np.abs(velocity), 0.0).sum(axis=1)
                total = short if total is None else total + short
        if total is None:
            return None
        return powered(total * np.float32(scene.settings.model_dt), p)
