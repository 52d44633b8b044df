# SPDX-License-Identifier: Apache-2.0
"""A joint that a slider moves, and that may be moved by others."""

from __future__ import annotations

from math import isfinite

from joint_state_publisher.free_joint import FreeJoint
from joint_state_publisher_gui.core.scale import Scale

__all__ = ['JointSlider']


class JointSlider:
    """
    What the slider of a joint shows.

    The slider that a person moves shows already what it is to show. So `news` is only what others
    have changed, and nothing that the person does comes back to be done again.

    Parameters
    ----------
    name
        The joint.
    joint
        Its state, which is set.
    scale
        The limits, and how positions are rounded.
    default
        The position that is shown as long as none is known, in rad or m.

    """

    def __init__(self, name: str, joint: FreeJoint, scale: Scale, default: float) -> None:
        self.name = name
        self.scale = scale
        self.default = default
        self._joint = joint
        self._seen = self.shown

    @property
    def position(self) -> float:
        """Return where the joint is, in radians or metres."""
        return self.default if self._joint.position is None else self._joint.position

    @property
    def shown(self) -> float:
        """Return where the slider is to be."""
        return self.scale.shown(self.position)

    def give(self, shown: float) -> None:
        """
        Move the joint to where a person has dragged the slider.

        Parameters
        ----------
        shown
            The value of the slider, in rad or m; one that is not finite is ignored.

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
        """Return where the slider is to be, if it is not there as far as it is known; once."""
        shown = self.shown
        if shown == self._seen:
            return None
        self._seen = shown
        return shown
