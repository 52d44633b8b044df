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

    At most one tool is in use. Its methods are called in the thread of the node, and points are in
    the fixed frame.

    Parameters
    ----------
    context
        What it works with: the node, the page, and the transforms.
    root
        The path of the scene below which it draws.
    given
        Its entry of the .rviz file, None for the defaults.

    Attributes
    ----------
    values
        The properties.

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
        """
        Apply a property that has been changed; by default close the tool and begin again.

        Parameters
        ----------
        path
            The path of the property, such as `Topic/Value`.

        """
        self.close()
        self.begin()

    def take_up(self) -> None:
        """Be the one that is in use."""

    def lay_down(self) -> None:
        """Be in use no longer."""

    def click(self, point: Point) -> bool:
        """
        Handle a click on the ground.

        Parameters
        ----------
        point
            Where, in m in the fixed frame.

        Returns
        -------
        bool
            Whether the tool is done, and to be laid down.

        """
        return False

    def drag(self, start: Point, end: Point, is_over: bool) -> bool:
        """
        Handle a drag over the ground, of which each movement is a call.

        Parameters
        ----------
        start, end
            Where the drag has begun, and where the pointer is now, in m in the fixed frame.
        is_over
            Whether the button has been released.

        Returns
        -------
        bool
            Whether the tool is done, and to be laid down.

        """
        return False
