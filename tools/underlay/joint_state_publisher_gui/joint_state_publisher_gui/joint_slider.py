# SPDX-License-Identifier: Apache-2.0
"""A joint whose position is set by a slider, and the scale of that slider."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, degrees, floor, isfinite, log10

from joint_state_publisher.merged_joints import FreeJoint

__all__ = ['JointSlider', 'Scale']

DECIMALS = 3
MOST_DECIMALS = 9
STEPS = 100
"""Minimum number of steps of a slider."""


class JointSlider:
    """
    The slider of a joint.

    A slider that a user drags already shows its new value. Therefore, `news` reports only changes
    from other sources, and user input is not echoed.

    Parameters
    ----------
    name
        The joint.
    joint
        The state of the joint, which the slider sets.
    scale
        The limits and the rounding of positions.
    default
        The position shown while none is known, in rad or m.

    """

    def __init__(self, name: str, joint: FreeJoint, scale: Scale, default: float) -> None:
        self.name = name
        self.scale = scale
        self.default = default
        self._joint = joint
        self._seen = self.shown

    @property
    def position(self) -> float:
        """Return the joint position, in rad or m."""
        return self.default if self._joint.position is None else self._joint.position

    @property
    def shown(self) -> float:
        """Return the value that the slider should display."""
        return self.scale.shown(self.position)

    def give(self, shown: float) -> None:
        """
        Move the joint to the position to which a user has dragged the slider.

        Parameters
        ----------
        shown
            The value of the slider, in rad or m; non-finite values are ignored.

        """
        if isfinite(shown):
            self._joint.position = self.scale.meant(shown)
            self._seen = shown

    def move(self, position: float) -> None:
        """
        Move the joint to a position, clamped to its limits.

        Parameters
        ----------
        position
            The position in rad or m.

        """
        self._joint.position = self.scale.within(position)

    def news(self) -> float | None:
        """Return the value of the slider if it has changed since the last call, else None."""
        shown = self.shown
        if shown == self._seen:
            return None
        self._seen = shown
        return shown


@dataclass(frozen=True)
class Scale:
    """
    Range of a slider between the limits of a joint, in rad or m, with its rounding.

    A slider shows few decimals, and its ends are rounded to lie within the limits; moving it to an
    end selects the exact limit.
    """

    lower: float
    upper: float
    is_angle: bool = True

    @property
    def decimals(self) -> int:
        """Return the number of decimals; it exceeds the default only for narrow limits."""
        width = self.upper - self.lower
        if width <= 0.0:
            return MOST_DECIMALS
        return min(max(DECIMALS, ceil(log10(STEPS / width))), MOST_DECIMALS)

    @property
    def step(self) -> float:
        """Return the increment of the slider."""
        return float(10.0**-self.decimals)

    @property
    def ends(self) -> tuple[float, float]:
        """Return the ends of the slider."""
        if self.upper - self.lower < self.step:
            return self.lower, self.upper
        factor = 10**self.decimals
        # The tolerance absorbs floating-point error, so that a limit is shown as it was written.
        first, last = self.lower * factor, self.upper * factor
        return ceil(first - 1e-6) / factor, floor(last + 1e-6) / factor

    def within(self, position: float) -> float:
        """
        Clamp a position to the limits.

        Parameters
        ----------
        position
            The position in rad or m.

        """
        return min(max(position, self.lower), self.upper)

    def shown(self, position: float) -> float:
        """
        Convert a position to the value of the slider, rounded and clamped to its ends.

        Parameters
        ----------
        position
            The position in rad or m.

        """
        first, last = self.ends
        return min(max(round(position, self.decimals), first), last)

    def meant(self, shown: float) -> float:
        """
        Convert the value of the slider to a position; the ends map to the exact limits.

        Parameters
        ----------
        shown
            The value of the slider, in rad or m.

        """
        first, last = self.ends
        if shown <= first:
            return self.lower
        return self.upper if shown >= last else shown

    def in_words(self, position: float) -> str:
        """
        Format a position in whole degrees or millimetres.

        Parameters
        ----------
        position
            The position in rad or m.

        """
        number = degrees(position) if self.is_angle else position * 1000.0
        return f'{round(number)}°' if self.is_angle else f'{round(number)}\u00a0mm'

    def describe(self) -> str:
        """Format the limits in both units."""
        unit = 'rad' if self.is_angle else 'm'
        return (
            f'{self.lower:.{self.decimals}f} to {self.upper:.{self.decimals}f} {unit} '
            f'({self.in_words(self.lower)} to {self.in_words(self.upper)})'
        )
