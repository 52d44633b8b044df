# SPDX-License-Identifier: Apache-2.0
"""The two sides of the robot: indices of pairs, left first, as in observations."""

from __future__ import annotations

LEFT, RIGHT = 0, 1
SIDES = (LEFT, RIGHT)
NAMES = ('left', 'right')


def other(side: int) -> int:
    """
    Get the opposite side.

    Parameters
    ----------
    side
        `LEFT` or `RIGHT`.

    """
    return 1 - side


def outwards(side: int) -> float:
    """
    Get the direction away from the body along y.

    Parameters
    ----------
    side
        `LEFT` or `RIGHT`.

    Returns
    -------
    float
        1 for the left side, -1 for the right one.

    """
    return 1.0 if side == LEFT else -1.0
