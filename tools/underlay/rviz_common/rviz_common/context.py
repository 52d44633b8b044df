# SPDX-License-Identifier: Apache-2.0
"""The objects that displays, tools and panels share."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TYPE_CHECKING

from rviz_common.frames import Frames
from rviz_common.inputs import on_click, on_input, WorkQueue

if TYPE_CHECKING:
    from rclpy.node import Node
    from rviz_common.page import Page
    from viser import GuiApi, SceneApi, ViserServer

__all__ = ['Context']


@dataclass(frozen=True)
class Context:
    """
    The objects that displays, tools and panels share; to be used in the node's thread only.

    Changes to the scene in one frame reach browsers together. Widget callbacks run in other
    threads: `on_input` and `on_click` transfer their work to the node's thread.
    """

    node: Node
    page: Page
    frames: Frames
    queue: WorkQueue
    visualizer: Any = None
    """The `Visualizer` that owns the context; optional in tests."""

    @property
    def server(self) -> ViserServer:
        """Return the server of the page."""
        return self.page.viser

    @property
    def scene(self) -> SceneApi:
        """The 3D scene."""
        return self.server.scene

    @property
    def gui(self) -> GuiApi:
        """Return the widgets of the page."""
        return self.server.gui

    def on_input(self, widget: Any, take: Callable[[Any], None]) -> None:
        """
        Call a function in the node's thread with each value that a user enters in a widget.

        Parameters
        ----------
        widget
            A widget of viser that has a value.
        take
            Receives the value. Values set by a program are not reported.

        """
        on_input(self.queue.post, widget, take)

    def on_click(self, button: Any, do: Callable[[], None]) -> None:
        """
        Call a function in the node's thread whenever a button is pressed.

        Parameters
        ----------
        button
            A button of viser.
        do
            Called without arguments.

        """
        on_click(self.queue.post, button, do)
