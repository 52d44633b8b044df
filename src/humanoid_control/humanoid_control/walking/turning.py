# SPDX-License-Identifier: Apache-2.0
"""Where the pelvis faces, and how fast that changes."""

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
        The headings at the start and at the end.
    time_s, duration_s
        The time since the start, and that of the whole turn.

    Returns
    -------
    Turning
        The heading and its rate at that time; later it stays at the end.

    """
    turn_rad, share = wrap_angle(to_rad - from_rad), min(1.0, time_s / duration_s)
    return Turning(
        from_rad + turn_rad * share**2 * (3.0 - 2.0 * share),
        turn_rad * 6.0 * share * (1.0 - share) / duration_s,
    )
