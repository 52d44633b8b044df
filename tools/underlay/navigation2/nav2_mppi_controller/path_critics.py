# SPDX-License-Identifier: Apache-2.0
"""Critics of MPPI that keep trajectories on the path."""

from __future__ import annotations

from dataclasses import dataclass
import math
from typing import Any

from nav2_mppi_controller.critics import (
    angle_magnitudes,
    Critic,
    CriticParameters,
    Floats,
    powered,
)
from nav2_mppi_controller.scene import Scene
from nav2_util.parameters import parameter
import numpy as np

__all__ = ['PathAlignCritic', 'PathAngleCritic', 'PathFollowCritic']


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
        turn = angle_magnitudes(trajectories.yaw - towards)
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
            away = np.hypot(away, angle_magnitudes(yaw - scene.path[:, 2][at]))
        sums = np.where(counts, away, 0.0).sum(axis=1)
        return powered(sums / np.maximum(counts.sum(axis=1), 1).astype(np.float32), p)
