# SPDX-License-Identifier: Apache-2.0
"""What displays, tools and panels have at hand."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TYPE_CHECKING

from rviz_common.frames import Frames
from rviz_common.inputs import on_click, on_input
from rviz_common.work_queue import WorkQueue

if TYPE_CHECKING:
    from rclpy.node import Node
    from rviz_common.page import Page
    from viser import GuiApi, SceneApi, ViserServer

__all__ = ['Context']


@dataclass(frozen=True)
class Context:
    """
    What displays, tools and panels have at hand; it is used in the thread of the node only.

    What is set of the scene in one frame reaches browsers together. Callbacks of widgets come in
    other threads: `on_input` and `on_click` bring what they do to the thread of the node.
    """

    node: Node
    page: Page
    frames: Frames
    queue: WorkQueue
    visualizer: Any = None
    """The `Visualizer` that owns all this; a test may do without."""

    @property
    def server(self) -> ViserServer:
        """Return the server of the page."""
        return self.page.viser

    @property
    def scene(self) -> SceneApi:
        """Return what is drawn in three dimensions."""
        return self.server.scene

    @property
    def gui(self) -> GuiApi:
        """Return the widgets of the page."""
        return self.server.gui

    def on_input(self, widget: Any, take: Callable[[Any], None]) -> None:
        """
        Call a function in the thread of the node with each value that a user gives to a widget.

        Parameters
        ----------
        widget
            A widget of viser that has a value.
        take
            Receives the value. Values that a program sets are not passed on.

        """
        on_input(self.queue.post, widget, take)

    def on_click(self, button: Any, do: Callable[[], None]) -> None:
        """
        Call a function in the thread of the node whenever a button is pressed.

        Parameters
        ----------
        button
            A button of viser.
        do
            Called without arguments.

        """
        on_click(self.queue.post, button, do)
