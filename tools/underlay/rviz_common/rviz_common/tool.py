# SPDX-License-Identifier: Apache-2.0
"""The base classes of tools: for the ground, and for the objects of the scene."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from rviz_common.context import Context
from rviz_common.properties import Property, Values
from rviz_common.selection import Point, Ray

__all__ = ['Drag', 'ObjectTool', 'Point', 'Tool']

COMMON = ('Class',)


class Tool:
    """
    A tool for the pointer on the ground, which is the plane z = 0 of the fixed frame.

    At most one tool is active. Its methods are called in the thread of the node, and points are in
    the fixed frame.

    Parameters
    ----------
    context
        The node, the page and the transforms.
    root
        The path of the scene below which it draws.
    given
        Its entry in the .rviz file, None for the defaults.

    Attributes
    ----------
    values
        The properties.
    browser
        The number of the browser whose click or drag it gets; None before the first one.

    """

    CLASS: ClassVar[str]
    """The class name in the file, such as `rviz_default_plugins/SetGoal`."""
    NAME: ClassVar[str]
    """The label of the button."""
    HINT: ClassVar[str]
    """A sentence on how to use the tool."""
    PROPERTIES: ClassVar[tuple[Property, ...]] = ()
    UNUSED: ClassVar[tuple[str, ...]] = ()
    """Properties of RViz, by top-level name, that do not apply in a browser."""

    def __init__(
        self, context: Context, root: str, given: Mapping[str, Any] | None = None
    ) -> None:
        self.context = context
        self.root = root
        self.values = Values(self.PROPERTIES, given)
        self.browser: int | None = None

    @property
    def unknown(self) -> list[str]:
        """The properties in the file that are unknown."""
        return self.values.unknown((*COMMON, *self.UNUSED))

    def to_file(self) -> dict[str, Any]:
        """Return the entry for the .rviz file."""
        return {**self.values.to_file(), 'Class': self.CLASS}

    def begin(self) -> None:
        """Prepare the tool for its first use."""

    def close(self) -> None:
        """Release the resources of the tool."""

    def on_change(self, path: str) -> None:
        """
        Apply a property that was changed; by default close the tool and prepare it again.

        Parameters
        ----------
        path
            The path of the property, such as `Topic/Value`.

        """
        self.close()
        self.begin()

    def update(self) -> None:
        """Update what the tool draws; called for each frame."""

    def take_up(self) -> None:
        """Activate the tool."""

    def lay_down(self) -> None:
        """Deactivate the tool."""

    def click(self, point: Point) -> bool:
        """
        Handle a click on the ground.

        Parameters
        ----------
        point
            The position, in m in the fixed frame.

        Returns
        -------
        bool
            Whether the tool is done, and to be deactivated.

        """
        return False

    def drag(self, start: Point, end: Point, is_over: bool) -> bool:
        """
        Handle a drag over the ground; called for each movement.

        Parameters
        ----------
        start, end
            The start of the drag and the current position of the pointer, in m in the fixed frame.
        is_over
            Whether the button has been released.

        Returns
        -------
        bool
            Whether the tool is done, and to be deactivated.

        """
        return False


@dataclass(frozen=True)
class Drag:
    """A movement of the pointer with the button pressed; rays are in the fixed frame."""

    start: Ray
    """Through the point where the button was pressed."""
    now: Ray
    is_over: bool
    """Whether the button has been released, or the browser is gone."""
    browser: int
    """The number of the browser, as several of them may drag at the same time."""


class ObjectTool(Tool):
    """
    A tool for the objects of the scene, which gets rays instead of points of the ground.

    Parameters
    ----------
    context, root, given
        As for `Tool`.

    """

    TAKES_DRAGS: ClassVar[bool] = False
    """Whether it gets drags, which then do not turn the scene."""

    def click_along(self, ray: Ray) -> bool:
        """
        Handle a click anywhere in the scene.

        Parameters
        ----------
        ray
            From the eye through the pointer, in the fixed frame.

        Returns
        -------
        bool
            Whether the tool is done, and to be deactivated.

        """
        return False

    def drag_along(self, drag: Drag) -> bool:
        """
        Handle a drag anywhere in the scene; called for each movement.

        Parameters
        ----------
        drag
            The drag so far.

        Returns
        -------
        bool
            Whether the tool is done, and to be deactivated.

        """
        return False
