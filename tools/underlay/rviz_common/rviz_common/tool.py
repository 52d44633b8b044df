# SPDX-License-Identifier: Apache-2.0
"""What the pointer does in the scene."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from rviz_common.context import Context
from rviz_common.properties import Property, Values

__all__ = ['Point', 'Tool']

Point = tuple[float, float, float]

COMMON = ('Class',)


class Tool:
    """
    Something that the pointer does on the ground, which is the plane z = 0 of the fixed frame.

    At most one tool is in use. Its methods come in the thread of the node, and points are in the
    fixed frame.
    """

    CLASS: ClassVar[str]
    """The class that the file names, such as `rviz_default_plugins/SetGoal`."""
    NAME: ClassVar[str]
    """What the button says."""
    HINT: ClassVar[str]
    """What to do, in a sentence."""
    PROPERTIES: ClassVar[tuple[Property, ...]] = ()
    UNUSED: ClassVar[tuple[str, ...]] = ()
    """Properties of RViz, by their first name, that mean nothing in a browser."""

    def __init__(
        self, context: Context, root: str, given: Mapping[str, Any] | None = None
    ) -> None:
        """Take the properties that a file gives; it draws below `root`, a path of the scene."""
        self.context = context
        self.root = root
        self.values = Values(self.PROPERTIES, given)

    @property
    def unknown(self) -> list[str]:
        """Return the properties of the file that nobody knows."""
        return self.values.unknown((*COMMON, *self.UNUSED))

    def to_file(self) -> dict[str, Any]:
        """Return what the file is to have."""
        return {**self.values.to_file(), 'Class': self.CLASS}

    def begin(self) -> None:
        """Do what is to be done before the first use."""

    def close(self) -> None:
        """End what has been begun."""

    def on_change(self, path: str) -> None:
        """Follow a property that has been changed: begin anew, by default."""
        self.close()
        self.begin()

    def take_up(self) -> None:
        """Be the one that is in use."""

    def lay_down(self) -> None:
        """Be in use no longer."""

    def click(self, point: Point) -> bool:
        """Take a click; return whether the tool is done."""
        return False

    def drag(self, start: Point, end: Point, is_over: bool) -> bool:
        """Take a drag, which goes on until it is over; return whether the tool is done."""
        return False
