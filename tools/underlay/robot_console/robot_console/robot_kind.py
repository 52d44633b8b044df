# SPDX-License-Identifier: Apache-2.0
"""Whether a robot is real."""

from __future__ import annotations

__all__ = ['AUTO', 'KINDS', 'REAL', 'SIMULATED', 'UNKNOWN', 'robot_kind']

AUTO, REAL, SIMULATED, UNKNOWN = 'auto', 'real', 'simulated', 'unknown'
KINDS = (AUTO, REAL, SIMULATED)


def robot_kind(told: str, clock_publishers: int) -> str:
    """Return what a robot is; without being told, nothing is called real."""
    if told != AUTO:
        return told
    return SIMULATED if clock_publishers else UNKNOWN
