# SPDX-License-Identifier: Apache-2.0
"""Distinction between real and simulated robots."""

from __future__ import annotations

__all__ = ['AUTO', 'KINDS', 'REAL', 'SIMULATED', 'UNKNOWN', 'robot_kind']

AUTO, REAL, SIMULATED, UNKNOWN = 'auto', 'real', 'simulated', 'unknown'
KINDS = (AUTO, REAL, SIMULATED)


def robot_kind(told: str, clock_publishers: int) -> str:
    """
    Determine whether a robot is reported as real or simulated.

    Parameters
    ----------
    told
        One of `KINDS`; any value except `AUTO` is set by the user, and returned unchanged.
    clock_publishers
        The number of publishers of `/clock`; simulators publish it.

    Returns
    -------
    str
        `REAL`, `SIMULATED` or `UNKNOWN`; `AUTO` never results in `REAL`.

    """
    if told != AUTO:
        return told
    return SIMULATED if clock_publishers else UNKNOWN
