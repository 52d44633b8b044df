# SPDX-License-Identifier: Apache-2.0
"""The base class of panels."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, TYPE_CHECKING

from rviz_common.context import Context
from rviz_common.plugins import name_of
from rviz_common.properties import Flag, Property, Values

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['DOCKED', 'Panel']

COMMON = ('Class', 'Name')

DOCKED = Flag('Docked', False, 'Whether the panel is on the left side of the page, not in a tab.')


class Panel:
    """
    An entry of the list of panels.

    `start` is called once, in a context that places the widgets that it adds into the panel;
    `update` is called for each frame.

    Parameters
    ----------
    context
        The node, the page and the transforms.
    given
        Its entry in the .rviz file, None for a panel that no file lists.

    Attributes
    ----------
    name
        The title of its tab.
    values
        The properties.

    """

    CLASS: ClassVar[str]
    """The class name in the file, such as `rviz_common/Displays`."""
    PROPERTIES: ClassVar[tuple[Property, ...]] = ()
    UNUSED: ClassVar[tuple[str, ...]] = ()
    """Properties of RViz, by top-level name, that do not apply in a browser."""
    FOLLOWS: ClassVar[str] = ''
    """The class of the panel next to whose tab a panel on demand appears; '' for the last tab."""
    IS_ALWAYS_VISIBLE: ClassVar[bool] = False
    """Whether it is outside the tabs; it must then remove its widgets itself when closed."""

    def __init__(self, context: Context, given: Mapping[str, Any] | None = None) -> None:
        self.context = context
        self.name = name_of(given, self.CLASS)
        docked = () if self.IS_ALWAYS_VISIBLE else (DOCKED,)
        self.values = Values((*docked, *self.PROPERTIES), given)

    @property
    def is_docked(self) -> bool:
        """Whether it is on the left side of the page, not in a tab."""
        return not self.IS_ALWAYS_VISIBLE and bool(self.values[DOCKED.path])

    def dock(self, is_docked: bool) -> None:
        """
        Remember in the file whether the panel is on the left side of the page.

        Parameters
        ----------
        is_docked
            Whether it is there.

        """
        self.values[DOCKED.path] = is_docked

    @classmethod
    def is_wanted(cls, node: Node) -> bool:
        """
        Whether a panel on demand is to appear, as its subject is available; by default False.

        Parameters
        ----------
        node
            The node whose graph is examined, every 2 s until it is wanted.

        """
        return False

    @property
    def unknown(self) -> list[str]:
        """The properties in the file that are unknown."""
        return self.values.unknown((*COMMON, *self.UNUSED))

    def to_file(self) -> dict[str, Any]:
        """Return the entry for the .rviz file."""
        written = self.values.to_file()
        if 'Class' not in written:
            written.update({'Class': self.CLASS, 'Name': self.name})
        return written

    def start(self) -> None:
        """Add the widgets."""
        raise NotImplementedError

    def update(self) -> None:
        """Update the widgets."""

    def close(self) -> None:
        """Release the resources of the panel; its widgets are removed with the page."""
