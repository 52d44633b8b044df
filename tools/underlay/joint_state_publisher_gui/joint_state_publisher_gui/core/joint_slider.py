# SPDX-License-Identifier: Apache-2.0
"""A joint whose position is set by a slider and possibly by other sources."""

from __future__ import annotations

from math import isfinite

from joint_state_publisher.free_joint import FreeJoint
from joint_state_publisher_gui.core.scale import Scale

__all__ = ['JointSlider']


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
