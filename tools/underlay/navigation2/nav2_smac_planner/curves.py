# SPDX-License-Identifier: Apache-2.0
"""
Shortest curves of a car between two poses: arcs of its turning radius, and straight lines.

Sources: L. E. Dubins, On Curves of Minimal Length, 1957; J. A. Reeds, L. A. Shepp, Optimal Paths
for a Car That Goes Both Forwards and Backwards, 1990. Of the latter, the words of three segments
are used.
"""

from __future__ import annotations

from collections.abc import Iterator
import math
from typing import NamedTuple

from nav2_util.geometry import Pose2D, wrap_angle
import numpy as np
import numpy.typing as npt

__all__ = ['Segment', 'sample_curve', 'shortest_curve']

FloatArray = npt.NDArray[np.float64]
_FULL = 2.0 * math.pi


class Segment(NamedTuple):
    """A part of a curve: left (1), straight (0) or right (-1)."""

    steer: int
    length_m: float
    """Negative if the car drives backward."""


def shortest_curve(
    start: Pose2D,
    goal: Pose2D,
    radius_m: float,
    *,
    can_reverse: bool,
    reverse_factor: float = 1.0,
) -> list[Segment]:
    """
    Find the shortest curve of three segments between two poses.

    Parameters
    ----------
    start, goal
        The poses, in the same frame.
    radius_m
        The turning radius.
    can_reverse
        Whether the car may drive backward.
    reverse_factor
        How much more a metre backward counts than one forward.

    Returns
    -------
    list of Segment
        The segments from the start to the goal.

    """
    way = start.inverse() @ goal
    scaled = Pose2D(way.x / radius_m, way.y / radius_m, way.yaw)
    words = _with_reversing(scaled) if can_reverse else _forward(scaled)

    def cost(word: list[Segment]) -> float:
        return sum(
            each.length_m if each.length_m >= 0.0 else -reverse_factor * each.length_m
            for each in word
        )

    return [Segment(each.steer, each.length_m * radius_m) for each in min(words, key=cost)]


def sample_curve(
    start: Pose2D, segments: list[Segment], radius_m: float, step_m: float
) -> FloatArray:
    """
    Compute poses along a curve.

    Parameters
    ----------
    start
        The pose at which it starts.
    segments
        Its segments.
    radius_m
        The turning radius.
    step_m
        The largest distance between two poses.

    Returns
    -------
    numpy.ndarray
        (N, 3) x, y in m and yaw in rad, without the start.

    """
    parts = [np.empty((0, 3))]
    for steer, length in segments:
        count = math.ceil(abs(length) / step_m - 1e-9)
        if not count:
            continue
        lengths = length * np.arange(1, count + 1) / count
        yaws = steer * lengths / radius_m
        if steer:
            x, y = radius_m * steer * np.sin(yaws), radius_m * steer * (1.0 - np.cos(yaws))
        else:
            x, y = lengths, np.zeros(count)
        cos, sin = math.cos(start.yaw), math.sin(start.yaw)
        part = np.column_stack(
            [start.x + cos * x - sin * y, start.y + sin * x + cos * y, start.yaw + yaws]
        )
        parts.append(part)
        start = Pose2D(*part[-1].tolist())
    poses = np.concatenate(parts)
    poses[:, 2] = np.arctan2(np.sin(poses[:, 2]), np.cos(poses[:, 2]))
    return poses


def _forward(way: Pose2D) -> Iterator[list[Segment]]:
    """Find the curves without reversing, for a turning radius of 1."""
    for side, mirrored in _sides(way):
        for steers, (first, middle, last) in _words(mirrored):
            if steers[1] == -1:  # the other way round the circle between two others
                middle %= _FULL
            yield _segments(side, steers, (first % _FULL, middle, last % _FULL))


def _with_reversing(way: Pose2D) -> Iterator[list[Segment]]:
    """Find the curves with reversing, for a turning radius of 1."""
    for direction in (1.0, -1.0):
        flipped = Pose2D(direction * way.x, way.y, direction * way.yaw)
        for side, mirrored in _sides(flipped):
            for steers, (first, middle, last) in _words(mirrored):
                lengths = wrap_angle(first), middle, wrap_angle(last)
                a, b, c = (direction * each for each in lengths)
                yield _segments(side, steers, (a, b, c))


def _sides(way: Pose2D) -> Iterator[tuple[int, Pose2D]]:
    yield 1, way
    yield -1, Pose2D(way.x, -way.y, -way.yaw)


def _segments(
    side: int, steers: tuple[int, int, int], lengths: tuple[float, float, float]
) -> list[Segment]:
    return [
        Segment(side * steer, length)
        for steer, length in zip(steers, lengths)
        if abs(length) > 1e-9
    ]


def _words(way: Pose2D) -> Iterator[tuple[tuple[int, int, int], tuple[float, float, float]]]:
    """Find the words that start to the left: steering and lengths; arcs are modulo 2 pi."""
    sin, cos = math.sin(way.yaw), math.cos(way.yaw)
    x, y = way.x - sin, way.y - 1.0 + cos
    apart, angle = math.hypot(x, y), math.atan2(y, x)
    yield (1, 0, 1), (angle, apart, way.yaw - angle)
    if apart <= 4.0:
        between = -2.0 * math.asin(apart / 4.0)
        first = angle + 0.5 * between + math.pi
        yield (1, -1, 1), (first, between, way.yaw - first + between)
    x, y = way.x + sin, way.y - 1.0 - cos
    apart = math.hypot(x, y)
    if apart >= 2.0:
        straight = math.sqrt(apart * apart - 4.0)
        first = math.atan2(y, x) + math.atan2(2.0, straight)
        yield (1, 0, -1), (first, straight, first - way.yaw)
