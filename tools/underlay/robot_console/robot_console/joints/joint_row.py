# SPDX-License-Identifier: Apache-2.0
"""A row of the joint table."""

from __future__ import annotations

from dataclasses import dataclass

from robot_console.joints.joint_state import JointState
from rviz_common.status import Level
from urdf import Joint, Limits

__all__ = ['JointRow', 'load_level', 'position_level']

UNKNOWN = JointState()
NEAR = 0.9
NEAR_LIMIT = 0.05


@dataclass(frozen=True)
class JointRow:
    """Measured state, commanded position and description of a joint."""

    name: str
    label: str
    joint: Joint | None = None
    state: JointState = UNKNOWN
    target: float | None = None
    is_stale: bool = False

    @property
    def is_angle(self) -> bool:
        """Whether positions are angles; joints without a description are taken as revolute."""
        return self.joint is None or self.joint.kind != 'prismatic'

    @property
    def limits(self) -> Limits | None:
        """Return the position limits of the joint."""
        limits = self.joint.limits if self.joint else None
        return limits if limits and limits.lower < limits.upper else None

    @property
    def error(self) -> float | None:
        """Return the position error: target minus measured position."""
        if self.target is None or self.state.position is None:
            return None
        return self.target - self.state.position

    def share(self, position: float | None) -> float | None:
        """
        Scale a position to the range of the joint.

        Parameters
        ----------
        position
            In rad or m; None if unknown.

        Returns
        -------
        float or None
            0 at or below the lower limit, 1 at or above the upper limit; None without a position
            or limits.

        """
        if position is None or self.limits is None:
            return None
        span = self.limits.upper - self.limits.lower
        return min(max((position - self.limits.lower) / span, 0.0), 1.0)


def position_level(row: JointRow) -> Level:
    """
    Rate the proximity of a joint to its position limits.

    Parameters
    ----------
    row
        The joint.

    Returns
    -------
    Level
        WARN within 5 % of the range from a limit, ERROR beyond the limits, otherwise OK.

    """
    position, limits = row.state.position, row.limits
    if position is None or limits is None:
        return Level.OK
    if not limits.lower <= position <= limits.upper:
        return Level.ERROR
    margin = NEAR_LIMIT * (limits.upper - limits.lower)
    is_near = min(position - limits.lower, limits.upper - position) < margin
    return Level.WARN if is_near else Level.OK


def load_level(value: float | None, maximum: float | None) -> Level:
    """
    Rate the proximity of a velocity or an effort to its maximum.

    Parameters
    ----------
    value
        The measured value, of either sign; None if unknown.
    maximum
        The maximum magnitude, in the same unit; None if there is no limit.

    Returns
    -------
    Level
        WARN from 90 % of the maximum, ERROR beyond it, otherwise OK.

    """
    if value is None or maximum is None or abs(value) < NEAR * maximum:
        return Level.OK
    return Level.ERROR if abs(value) > maximum else Level.WARN
