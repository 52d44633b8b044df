# SPDX-License-Identifier: Apache-2.0
"""The two sides of the robot: indices of pairs, left first, as in observations."""

from __future__ import annotations

LEFT, RIGHT = 0, 1
SIDES = (LEFT, RIGHT)
NAMES = ('left', 'right')


def other(side: int) -> int:
    """Return the opposite side."""
    return 1 - side


def outwards(side: int) -> float:
    """Return the direction away from the body along y: 1 for the left, -1 for the right side."""
    return 1.0 if side == LEFT else -1.0
