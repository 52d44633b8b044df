# SPDX-License-Identifier: Apache-2.0
"""Differences of angles, also within limits. All angles are in rad unless the name says so."""

from __future__ import annotations

import math

__all__ = [
    'find_min_max_delta',
    'from_degrees',
    'normalize_angle',
    'normalize_angle_positive',
    'shortest_angular_distance',
    'shortest_angular_distance_with_large_limits',
    'shortest_angular_distance_with_limits',
    'to_degrees',
    'two_pi_complement',
]

_TURN = 2.0 * math.pi


def normalize_angle_positive(angle: float) -> float:
    """
    Bring an angle into [0, 2 pi).

    Parameters
    ----------
    angle
        Any angle.

    """
    positive = angle % _TURN
    return positive if positive < _TURN else 0.0


def normalize_angle(angle: float) -> float:
    """
    Bring an angle into (-pi, pi].

    Parameters
    ----------
    angle
        Any angle.

    """
    positive = normalize_angle_positive(angle)
    return positive if positive <= math.pi else positive - _TURN


def shortest_angular_distance(from_angle: float, to_angle: float) -> float:
    """
    Compute the shortest turn from one angle to another.

    Parameters
    ----------
    from_angle, to_angle
        Any angles.

    Returns
    -------
    float
        The turn, in (-pi, pi].

    """
    return normalize_angle(to_angle - from_angle)


def two_pi_complement(angle: float) -> float:
    """
    Compute the turn in the other direction that ends at the same angle.

    Parameters
    ----------
    angle
        The turn.

    Returns
    -------
    float
        The turn in the other direction, from -2 pi to 2 pi.

    """
    turn = math.fmod(angle, _TURN)
    return turn + _TURN if turn <= 0.0 else turn - _TURN


def find_min_max_delta(
    from_angle: float, left_limit: float, right_limit: float
) -> tuple[bool, float, float]:
    """
    Compute how far a joint can turn until its limits.

    Parameters
    ----------
    from_angle
        The angle of the joint.
    left_limit, right_limit
        The limits: the joint can be at all angles that it passes when it turns from the left to
        the right one in the positive direction. [0.25, -0.25] has pi, and not 0.

    Returns
    -------
    tuple
        Whether the joint is within its limits, and its turns to the left and to the right one: if
        it is within, turns that do not leave the interval, otherwise the shortest ones.

    """
    width = _place(right_limit, left_limit, right_limit)
    place = _place(from_angle, left_limit, right_limit)
    if place <= width:
        return True, -place, width - place
    return (
        False,
        shortest_angular_distance(from_angle, left_limit),
        shortest_angular_distance(from_angle, right_limit),
    )


def shortest_angular_distance_with_limits(
    from_angle: float, to_angle: float, left_limit: float, right_limit: float
) -> tuple[bool, float]:
    """
    Compute the turn from one angle to another that stays within limits.

    Parameters
    ----------
    from_angle, to_angle
        The angles.
    left_limit, right_limit
        The limits, within a turn, as in `find_min_max_delta`.

    Returns
    -------
    tuple
        Whether both angles are within the limits, and the turn: if they are not, the shortest one.

    """
    width = _place(right_limit, left_limit, right_limit)
    start = _place(from_angle, left_limit, right_limit)
    end = _place(to_angle, left_limit, right_limit)
    if start <= width and end <= width:
        return True, end - start
    return False, shortest_angular_distance(from_angle, to_angle)


def shortest_angular_distance_with_large_limits(
    from_angle: float, to_angle: float, left_limit: float, right_limit: float
) -> tuple[bool, float]:
    """
    Compute the shortest turn within limits that may be more than a turn apart.

    Parameters
    ----------
    from_angle
        Where the turn begins, between the limits.
    to_angle
        Where it ends, up to whole turns.
    left_limit, right_limit
        The limits; the left one is the smaller one.

    Returns
    -------
    tuple
        Whether there is such a turn, and the turn: if there is not, the shortest one.

    """
    turn = shortest_angular_distance(from_angle, to_angle)
    if left_limit > right_limit or not left_limit <= from_angle <= right_limit:
        return False, turn
    for each in (turn, two_pi_complement(turn)):
        if left_limit <= from_angle + each <= right_limit:
            return True, each
    return False, turn


def to_degrees(radians: float) -> float:
    """
    Convert an angle to degrees.

    Parameters
    ----------
    radians
        The angle.

    """
    return math.degrees(radians)


def from_degrees(degrees: float) -> float:
    """
    Convert an angle from degrees.

    Parameters
    ----------
    degrees
        The angle.

    """
    return math.radians(degrees)


def _place(angle: float, left_limit: float, right_limit: float) -> float:
    """Return how far an angle is from the left limit in the positive direction."""
    if left_limit <= angle <= right_limit <= left_limit + _TURN:
        return angle - left_limit
    return normalize_angle_positive(angle - left_limit)
