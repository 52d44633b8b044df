# SPDX-License-Identifier: Apache-2.0
"""Heading of the pelvis, and its rate."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_control.dynamics.rotations import wrap_angle


@dataclass(frozen=True)
class Turning:
    """A heading and its rate."""

    heading_rad: float
    rate_rad_s: float = 0.0


def smooth_turn(from_rad: float, to_rad: float, time_s: float, duration_s: float) -> Turning:
    """
    Interpolate between two headings the short way round, at rest at both ends.

    Parameters
    ----------
    from_rad, to_rad
        Headings at the start and at the end.
    time_s, duration_s
        Time since the start, and duration of the whole turn.

    Returns
    -------
    Turning
        Heading and rate at that time; constant after the end.

    """
    turn_rad, share = wrap_angle(to_rad - from_rad), min(1.0, time_s / duration_s)
    return Turning(
        from_rad + turn_rad * share**2 * (3.0 - 2.0 * share),
        turn_rad * 6.0 * share * (1.0 - share) / duration_s,
    )
