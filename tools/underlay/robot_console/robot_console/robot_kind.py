# SPDX-License-Identifier: Apache-2.0
"""Whether a robot is real."""

from __future__ import annotations

__all__ = ['AUTO', 'KINDS', 'REAL', 'SIMULATED', 'UNKNOWN', 'robot_kind']

AUTO, REAL, SIMULATED, UNKNOWN = 'auto', 'real', 'simulated', 'unknown'
KINDS = (AUTO, REAL, SIMULATED)


def robot_kind(told: str, clock_publishers: int) -> str:
    """
    Decide whether a robot is called real or simulated.

    Parameters
    ----------
    told
        One of `KINDS`; anything but `AUTO` is what the user says, and returned as it is.
    clock_publishers
        How many publish `/clock`, as simulators do.

    Returns
    -------
    str
        `REAL`, `SIMULATED` or `UNKNOWN`; `AUTO` never leads to `REAL`.

    """
    if told != AUTO:
        return told
    return SIMULATED if clock_publishers else UNKNOWN
