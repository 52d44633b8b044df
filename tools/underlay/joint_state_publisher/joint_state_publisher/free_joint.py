# SPDX-License-Identifier: Apache-2.0
"""The state of an independent joint, which mimics no other joint."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

from urdf import Joint

__all__ = ['FreeJoint']


@dataclass
class FreeJoint:
    """The limits and the state of an independent joint; unknown quantities are None."""

    lower: float
    upper: float
    is_continuous: bool
    position: float | None = None
    velocity: float | None = None
    effort: float | None = None
    _direction: int = 1

    @classmethod
    def of(cls, joint: Joint, use_soft_limits: bool) -> FreeJoint:
        """
        Create a joint with the limits of its description and no known values.

        Parameters
        ----------
        joint
            The joint in the URDF.
        use_soft_limits
            Whether to apply the soft limits of `<safety_controller>` as well.

        Returns
        -------
        FreeJoint
            Its limits are in rad or m; -pi and pi for a continuous joint.

        """
        if joint.limits is None:
            return cls(-pi, pi, joint.kind == 'continuous')
        lower, upper = joint.limits.lower, joint.limits.upper
        if use_soft_limits and joint.soft_limits is not None:
            lower = max(lower, joint.soft_limits.lower)
            upper = min(upper, joint.soft_limits.upper)
        return cls(lower, upper, False)

    @property
    def is_known(self) -> bool:
        """Whether the position, velocity or effort is known."""
        return (self.position, self.velocity, self.effort) != (None, None, None)

    @property
    def zero(self) -> float:
        """Return the default position: 0, or the middle of the range if 0 is out of range."""
        return 0.0 if self.lower <= 0.0 <= self.upper else (self.lower + self.upper) / 2.0

    def move(self, delta: float) -> None:
        """
        Advance the position by a step, back and forth between the limits.

        A continuous joint wraps around to the other limit instead. Without a known position, the
        joint does not move.

        Parameters
        ----------
        delta
            The step, in rad or m.

        """
        if self.position is None:
            return
        position = self.position + self._direction * delta
        if not self.lower <= position <= self.upper:
            if self.is_continuous:
                position = self.lower if position > self.upper else self.upper
            else:
                self._direction = -1 if (position > self.upper) == (delta > 0) else 1
                position = min(max(position, self.lower), self.upper)
        self.position = position
