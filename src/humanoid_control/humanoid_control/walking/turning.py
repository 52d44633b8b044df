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
    """Return the heading at a time on the short way between two, at rest at both ends."""
    turn_rad, share = wrap_angle(to_rad - from_rad), min(1.0, time_s / duration_s)
    return Turning(
        from_rad + turn_rad * share**2 * (3.0 - 2.0 * share),
        turn_rad * 6.0 * share * (1.0 - share) / duration_s,
    )
