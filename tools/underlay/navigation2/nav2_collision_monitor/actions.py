# SPDX-License-Identifier: Apache-2.0
"""The actions of the zones around the robot on its velocity, also by the time to collision."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum
import math

from nav2_collision_monitor.shapes import FloatArray, Shape
from nav2_util.twist import Velocity
import numpy as np

__all__ = ['Action', 'ActionType', 'Zone', 'act_in_zone', 'collision_time', 'most_careful']

STOPPED = Velocity()

_BATCH = 200_000
_MOST_STEPS = 10_000


class ActionType(IntEnum):
    """Type of an action; the values are those of `nav2_msgs/CollisionMonitorState`."""

    DO_NOTHING = 0
    STOP = 1
    SLOWDOWN = 2
    APPROACH = 3
    LIMIT = 4


@dataclass(frozen=True)
class Action:
    """The resulting velocity, the action type, and the zone that caused it."""

    kind: ActionType
    velocity: Velocity
    zone: str = ''


@dataclass(frozen=True)
class Zone:
    """Snapshot of a zone; parameters as in the documentation of Nav2."""

    name: str
    kind: ActionType
    shape: Shape
    min_points: int = 4
    slowdown_ratio: float = 0.5
    linear_limit: float = 0.5
    angular_limit: float = 0.5
    time_before_collision: float = 2.0
    simulation_time_step: float = 0.1


def act_in_zone(zone: Zone, points: FloatArray, command: Velocity) -> Action:
    """
    Apply a zone to a commanded velocity.

    Parameters
    ----------
    zone
        Its shape, action and limits.
    points
        (N, 2) obstacles in m in the base frame.
    command
        The commanded velocity.

    """
    if zone.kind is ActionType.APPROACH:
        return _approach(zone, points, command)
    if zone.kind is ActionType.DO_NOTHING or not is_occupied(zone, points):
        return Action(ActionType.DO_NOTHING, command)
    if zone.kind is ActionType.STOP:
        return Action(zone.kind, STOPPED, zone.name)
    if zone.kind is ActionType.SLOWDOWN:
        return Action(zone.kind, command.scaled(zone.slowdown_ratio), zone.name)
    ratio = min(
        _ratio(zone.linear_limit, command.linear), _ratio(zone.angular_limit, abs(command.yaw))
    )
    if ratio >= 1.0:
        return Action(ActionType.DO_NOTHING, command)
    return Action(zone.kind, command.scaled(ratio), zone.name)


def is_occupied(zone: Zone, points: FloatArray) -> bool:
    """
    Whether a zone contains enough points.

    Parameters
    ----------
    zone
        Its shape, and `min_points`.
    points
        Obstacles (N, 2) in m in the base frame.

    """
    if len(points) < zone.min_points:
        return False
    return int(zone.shape.contains(points).sum()) >= zone.min_points


def most_careful(actions: Sequence[Action], command: Velocity) -> Action:
    """
    Choose the action with the lowest speed; a stop takes precedence.

    Parameters
    ----------
    actions
        The actions of the zones.
    command
        The commanded velocity, in the base frame.

    Returns
    -------
    Action
        The chosen one; the unchanged command if no zone acts.

    """
    chosen = Action(ActionType.DO_NOTHING, command)
    for each in actions:
        if each.kind is ActionType.STOP:
            return each
        if each.kind is not ActionType.DO_NOTHING and (
            chosen.kind is ActionType.DO_NOTHING
            or _effort(each.velocity) < _effort(chosen.velocity)
        ):
            chosen = each
    return chosen


def _approach(zone: Zone, points: FloatArray, command: Velocity) -> Action:
    """Scale the velocity so that the time to collision is at least `time_before_collision`."""
    time_s = collision_time(
        points,
        zone.shape,
        command,
        min_points=zone.min_points,
        horizon_s=zone.time_before_collision,
        step_s=zone.simulation_time_step,
    )
    if time_s is None or time_s >= zone.time_before_collision:
        return Action(ActionType.DO_NOTHING, command)
    ratio = time_s / zone.time_before_collision
    return Action(ActionType.APPROACH, command.scaled(ratio), zone.name)


def _ratio(limit: float, speed: float) -> float:
    return 1.0 if speed <= limit else limit / speed


def _effort(velocity: Velocity) -> float:
    return math.hypot(velocity.x, velocity.y, velocity.yaw)


def collision_time(
    points: FloatArray,
    shape: Shape,
    velocity: Velocity,
    *,
    min_points: int,
    horizon_s: float,
    step_s: float,
) -> float | None:
    """
    Compute when at least `min_points` are inside a shape that moves with the robot.

    Parameters
    ----------
    points
        (N, 2) obstacles in m in the base frame.
    shape
        The outline of the robot.
    velocity
        The velocity of the robot, assumed constant.
    min_points
        Fewer points are ignored as noise.
    horizon_s, step_s
        The prediction horizon and the time step.

    Returns
    -------
    float or None
        The time in s, 0 if they are already inside; None if not within the horizon.

    """
    step_s = max(step_s, horizon_s / _MOST_STEPS, 1e-6)
    times = np.arange(math.floor(horizon_s / step_s + 1e-9) + 1, dtype=np.float64) * step_s
    distances = np.hypot(points[:, 0], points[:, 1])
    points = points[distances <= shape.reach_m + velocity.linear * horizon_s]
    if len(points) < min_points:
        return None
    poses = velocity.poses_after(times)
    batch = max(_BATCH // len(points), 1)
    for start in range(0, len(poses), batch):
        x, y, yaw = poses[slice(start, start + batch)].T[:, :, np.newaxis]
        dx, dy = points[:, 0] - x, points[:, 1] - y
        cos, sin = np.cos(yaw), np.sin(yaw)
        seen = np.stack([cos * dx + sin * dy, cos * dy - sin * dx], axis=-1)
        hits = np.flatnonzero(shape.contains(seen).sum(axis=1) >= min_points)
        if hits.size:
            return float(times[start + hits[0]])
    return None
