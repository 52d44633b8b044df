# SPDX-License-Identifier: Apache-2.0
"""A group of widgets of the page."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, TYPE_CHECKING

from rviz_common.context import Context
from rviz_common.display import name_of
from rviz_common.properties import Property, Values

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['Panel']

COMMON = ('Class', 'Name')


class Panel:
    """
    An entry of the list of panels.

    `start` is called once, where the widgets that it adds get into the panel; `update` is called
    for each frame.

    Parameters
    ----------
    context
        What it works with: the node, the page, and the transforms.
    given
        Its entry of the .rviz file, None for a panel that no file lists.

    Attributes
    ----------
    name
        The title of its tab.
    values
        The properties.

    """

    CLASS: ClassVar[str]
    """The class that the file names, such as `rviz_common/Displays`."""
    PROPERTIES: ClassVar[tuple[Property, ...]] = ()
    UNUSED: ClassVar[tuple[str, ...]] = ()
    """Properties of RViz, by their first name, that mean nothing in a browser."""
    IS_ALWAYS_VISIBLE: ClassVar[bool] = False
    """Whether it is not in a tab; it then removes its widgets itself when it is closed."""

    def __init__(self, context: Context, given: Mapping[str, Any] | None = None) -> None:
        self.context = context
        self.name = name_of(given, self.CLASS)
        self.values = Values(self.PROPERTIES, given)

    @classmethod
    def is_wanted(cls, node: Node) -> bool:
        """
        Whether a panel on demand is to appear, since what it is for is there; by default False.

        Parameters
        ----------
        node
            The node through which to look, every 2 s until it is.

        """
        return False

    @property
    def unknown(self) -> list[str]:
        """Return the properties of the file that nobody knows."""
        return self.values.unknown((*COMMON, *self.UNUSED))

    def to_file(self) -> dict[str, Any]:
        """Return what the file is to have."""
        written = self.values.to_file()
        if 'Class' not in written:
            written.update({'Class': self.CLASS, 'Name': self.name})
        return written

    def start(self) -> None:
        """Add the widgets."""
        raise NotImplementedError

    def update(self) -> None:
        """Show what is new."""

    def close(self) -> None:
        """End what the panel has begun; its widgets go with the page."""
