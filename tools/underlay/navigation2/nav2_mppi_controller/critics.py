# SPDX-License-Identifier: Apache-2.0
"""Critics of MPPI for the path, the goal and the motion constraints."""

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
    'PathAlignCritic',
    'PathAngleCritic',
    'PathFollowCritic',
    'PreferForwardCritic',
    'TwirlingCritic',
    'VelocityDeadbandCritic',
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
class PathAlignParameters(CriticParameters):
    """The parameters of PathAlignCritic."""

    cost_weight: float = parameter(10.0, 'The weight of its cost.')
    threshold_to_consider: float = parameter(
        0.5, 'The distance in m from the goal beyond which the critic is asked.'
    )
    offset_from_furthest: int = parameter(
        20, 'How many poses of the path trajectories have to reach for the critic to be asked.'
    )
    trajectory_point_step: int = parameter(
        4, 'One in how many points of a trajectory counts.', low=1
    )
    max_path_occupancy_ratio: float = parameter(
        0.07, 'The part of the path in obstacles above which it is not asked.'
    )
    use_path_orientations: bool = parameter(False, 'Whether the yaw of the path counts, too.')


@dataclass(frozen=True)
class PathFollowParameters(CriticParameters):
    """The parameters of PathFollowCritic."""

    cost_weight: float = parameter(5.0, 'The weight of its cost.')
    threshold_to_consider: float = parameter(
        1.4, 'The distance in m from the goal beyond which the critic is asked.'
    )
    offset_from_furthest: int = parameter(
        6, 'How many poses beyond what trajectories reach the robot is drawn to.'
    )


@dataclass(frozen=True)
class PathAngleParameters(CriticParameters):
    """The parameters of PathAngleCritic."""

    cost_weight: float = parameter(2.2, 'The weight of its cost.')
    threshold_to_consider: float = parameter(
        0.5, 'The distance in m from the goal beyond which the critic is asked.'
    )
    offset_from_furthest: int = parameter(
        4, 'How many poses beyond what trajectories reach the robot has to face.'
    )
    max_angle_to_furthest: float = parameter(
        0.785398, 'The angle in rad to that pose above which the critic is asked.'
    )
    mode: int = parameter(
        0, '0: face along the path; 1: or away from it; 2: as its poses do.', low=0, high=2
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
        return powered(_magnitude(turn).mean(axis=1), p)


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


class PathFollowCritic(Critic):
    """Critic of the distance from the ends of trajectories to a pose ahead on the path."""

    kind = PathFollowParameters

    def _costs(self, scene: Scene, p: Any) -> Floats | None:
        if scene.goal_distance_m < p.threshold_to_consider or len(scene.path) < 2:
            return None
        x, y, _ = scene.path[scene.first_free(scene.furthest + p.offset_from_furthest)]
        trajectories = scene.trajectories
        away = np.hypot(trajectories.x[:, -1] - x, trajectories.y[:, -1] - y)
        return powered(away, p)


class PathAngleCritic(Critic):
    """Critic of the angle to the path, which turns the robot towards it."""

    kind = PathAngleParameters

    def _costs(self, scene: Scene, p: Any) -> Floats | None:
        if scene.goal_distance_m < p.threshold_to_consider:
            return None
        index = min(scene.furthest + p.offset_from_furthest, len(scene.path) - 1)
        x, y, yaw = (float(each) for each in scene.path[index])
        pose, trajectories = scene.state.pose, scene.trajectories
        here = math.atan2(y - pose.y, x - pose.x) - pose.yaw
        backward = p.mode == 2 and math.cos(yaw - math.atan2(y - pose.y, x - pose.x)) < 0.0
        if backward:
            here += math.pi
        angle = abs(math.remainder(here, 2.0 * math.pi))
        if p.mode == 1:
            angle = min(angle, math.pi - angle)
        if angle < p.max_angle_to_furthest:
            return None
        towards = np.arctan2(np.float32(y) - trajectories.y, np.float32(x) - trajectories.x)
        if backward:
            towards += np.float32(math.pi)
        turn = _magnitude(trajectories.yaw - towards)
        if p.mode == 1:
            turn = np.minimum(turn, np.float32(math.pi) - turn)
        return powered(turn.mean(axis=1), p)


class PathAlignCritic(Critic):
    """Critic of the distance between trajectories and the path, at equal arc lengths."""

    kind = PathAlignParameters

    def _costs(self, scene: Scene, p: Any) -> Floats | None:
        reached = scene.furthest
        if scene.goal_distance_m < p.threshold_to_consider or reached < p.offset_from_furthest:
            return None
        blocked = int(scene.path_blocked[:reached].sum())
        if blocked > 2 and blocked > p.max_path_occupancy_ratio * reached:
            return None
        step = p.trajectory_point_step
        x, y = scene.trajectories.x[:, ::step], scene.trajectories.y[:, ::step]
        driven = np.cumsum(np.hypot(np.diff(x, axis=1), np.diff(y, axis=1)), axis=1)
        lengths = scene.path_lengths[: reached + 1]
        at = np.searchsorted(lengths, driven.ravel()).reshape(driven.shape)
        counts = driven <= lengths[-1]
        np.minimum(at, reached, out=at)
        path = scene.path[:, :2].T
        away = np.hypot(x[:, 1:] - path[0][at], y[:, 1:] - path[1][at])
        if p.use_path_orientations:
            yaw = scene.trajectories.yaw[:, ::step][:, 1:]
            away = np.hypot(away, _magnitude(yaw - scene.path[:, 2][at]))
        sums = np.where(counts, away, 0.0).sum(axis=1)
        return powered(sums / np.maximum(counts.sum(axis=1), 1).astype(np.float32), p)


def _magnitude(angle: Floats) -> Floats:
    """Compute the magnitudes of angles in rad, from 0 to pi."""
    turns: Floats = angle * np.float32(0.5 / math.pi)
    turns -= np.rint(turns)
    return np.asarray(np.abs(turns) * np.float32(2.0 * math.pi), np.float32)
