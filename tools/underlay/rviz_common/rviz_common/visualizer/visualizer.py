# SPDX-License-Identifier: Apache-2.0
"""The visualizer: the displays, tools, views and panels of a file."""

from __future__ import annotations

import os
from typing import Any, TYPE_CHECKING

from rviz_common.config import ConfigError, Configuration, Place
from rviz_common.config.configuration import DISPLAYS, PANELS, SAVED_VIEWS, TOOLS, VIEW
from rviz_common.config.configuration import OPTIONS as OPTIONS_PLACE
from rviz_common.context import Context
from rviz_common.frames import FrameListener, Frames, WORLD
from rviz_common.pace import Pace
from rviz_common.panels.head import FileFolder, Head
from rviz_common.panels.panel_tabs import PanelTabs
from rviz_common.panels.phone_folder import PhoneFolder
from rviz_common.properties import topic_path, Values
from rviz_common.selection import Selection
from rviz_common.status import printable, Statuses
from rviz_common.view import Cameras, View
from rviz_common.visualizer.display_entry import Maker
from rviz_common.visualizer.display_tree import Entry, Group
from rviz_common.visualizer.frame_loop import Attention, FrameLoop
from rviz_common.visualizer.global_options import (
    BACKGROUND,
    FIXED_FRAME,
    FRAME_RATE,
    FrameWatch,
    GROUND,
    OPTIONS,
    THEME,
)
from rviz_common.visualizer.reports import surprises
from rviz_common.visualizer.tool_box import ToolBox
from rviz_common.visualizer.viewers import Viewers
from tf2_ros import Buffer

if TYPE_CHECKING:
    from rclpy.node import Node
    from rviz_common.page import Page

__all__ = ['Visualizer']


class Visualizer:
    """
    Shows the displays, tools, views and panels of a .rviz file in a page.

    Everything is done in the node's thread, once the node spins.

    Parameters
    ----------
    node
        The node that subscribes, and whose executor draws the frames.
    page
        The page, without any widgets yet.
    configuration
        The configuration to show.
    path
        The file that it is from, '' for none.
    may_rest
        Whether drawing and subscriptions to streams of data are suspended while no page is open.

    Attributes
    ----------
    context
        The context of displays, tools and panels.
    status
        The global status, which reports whether the fixed frame is known.
    options
        The global options.
    displays, tools, panels
        The displays, tools and panels that are shown.
    selection
        The object that is selected.
    cameras, saved_views
        The cameras of browsers, which show the current view; and the saved views.
    revision
        A counter that is incremented whenever a display is added or removed.

    """

    def __init__(
        self,
        node: Node,
        page: Page,
        configuration: Configuration,
        path: str = '',
        may_rest: bool = False,
    ) -> None:
        self._buffer = Buffer()
        self._listener = FrameListener(self._buffer, node)
        attention = Attention(
            node, self._listener, lambda: bool(page.viser.get_clients()), may_rest
        )
        self._loop = FrameLoop(node, self.frame, attention)
        frames = Frames(self._buffer)
        self.context = Context(node, page, frames, self._loop.queue, self)
        self.status = Statuses()
        self.watch = FrameWatch(node, frames, self.status)
        self._logger = node.get_logger()
        self._pace, self._slow = Pace(), Pace(1.0)
        self._maker = Maker(self.context, f'{WORLD}/displays')
        self._viewers = Viewers(self.context)
        self._open(configuration, path)
        self._files = FileFolder(self.context)
        self._phone = PhoneFolder(self.context)
        page.viser.on_client_connect(lambda _: self._loop.rouse())

    def load(self, configuration: Configuration, path: str = '') -> None:
        """
        Replace the current configuration by another one.

        Parameters
        ----------
        configuration
            The configuration to show.
        path
            The file that it is from, '' for none.

        """
        self._close()
        self._open(configuration, path)

    def save(self, path: str) -> None:
        """
        Write the current configuration to a .rviz file.

        Parameters
        ----------
        path
            The file, which becomes `self.path`; `~` stands for the home directory.

        Raises
        ------
        ConfigError
            The name does not end with .rviz, or the file cannot be written.

        """
        path = os.path.expanduser(path.strip())
        if not path.endswith('.rviz'):
            raise ConfigError(path or 'The file', None, 'The file name must end with .rviz.')
        self.configuration.save(path, _sections(self))
        self.path = path

    def text(self) -> str:
        """Return the current configuration as the text of a .rviz file."""
        return self.configuration.text(_sections(self))

    def set_option(self, path: str, value: Any) -> None:
        """
        Set a global option, and apply it.

        Parameters
        ----------
        path, value
            The name of the option, such as `FIXED_FRAME`, and its new value.

        Raises
        ------
        ValueError
            The value is invalid; the message is that of `Property.read`.

        """
        self.options[path] = value
        self._apply(path)

    def add(self, class_name: str, topic: str = '') -> Entry:
        """
        Add a display with its defaults, and show it.

        Parameters
        ----------
        class_name
            The class, such as `rviz_default_plugins/Grid`.
        topic
            The topic to show, '' for the default one.

        Returns
        -------
        Entry
            The entry of the display.

        Raises
        ------
        LookupError
            No installed package offers the class.
        ImportError
            The module of the class cannot be imported.

        """
        entry = self._maker.new(class_name)
        path = topic_path(entry.display.PROPERTIES)
        if topic and path:
            entry.display.values[path] = topic
        self.displays.add(entry)
        self.revision += 1
        return entry

    def remove(self, entry: Entry) -> None:
        """
        Remove a display or a group.

        Parameters
        ----------
        entry
            Its entry, anywhere in the tree.

        """
        if self.displays.remove(entry):
            self.revision += 1

    def frame(self) -> None:
        """Draw the next frame; while no page is open, run only the essential work."""
        self._loop.attend()
        if self._loop.rests and not self._slow.is_due():
            self.panels.update()
            return
        self._listener.take_all()
        if self._pace.is_due():
            self.watch.update()
        with self.context.server.atomic():
            if not self._loop.rests:
                self._viewers.update()
            self.cameras.update()
            self.displays.update()
            self.selection.update()
            self.tools.update()
            self.head.update()
            self.panels.update()

    def notify(self, title: str, text: str) -> None:
        """
        Show a notification in all browsers for 10 s, and log it.

        Parameters
        ----------
        title, text
            The headline, and the message.

        """
        self._logger.info(f'{title}: {text}')
        for client in self.context.server.get_clients().values():
            client.add_notification(title, printable(text), auto_close_seconds=10.0)

    def close(self) -> None:
        """Close all displays, tools and panels."""
        self._loop.close()
        self._close()
        self._files.close()
        self._phone.close()
        self._viewers.close()
        self._listener.unregister()

    def _open(self, configuration: Configuration, path: str) -> None:
        self.configuration, self.path = configuration, path
        self.revision = 0
        self.options = Values(OPTIONS, configuration.options)
        for option in (BACKGROUND, FIXED_FRAME):
            self._apply(option)
        self.cameras = Cameras(self.context, View(configuration.view))
        self.saved_views = [View(each) for each in configuration.saved_views]
        self.displays = Group({}, [self._maker.entry(each) for each in configuration.displays])
        self.selection = Selection(self.displays.pick)
        self.tools = ToolBox(self.context, lambda: self.cameras.origin, configuration.tools)
        self.displays.appear(True)
        self.watch.update()
        self.head = Head(self.context, self)
        self.panels = PanelTabs(self.context, configuration.panels)
        self._loop.set_rate(self.options[FRAME_RATE])
        for sentence in surprises(self):
            self._logger.warning(sentence)

    def _close(self) -> None:
        self.panels.close()
        self.head.close()
        self.tools.close()
        self.selection.choose(None)
        self.displays.appear(False)
        self._viewers.clear()
        self.context.scene.remove_by_name(WORLD)

    def _apply(self, option: str) -> None:
        """Apply a global option."""
        value = self.options[option]
        if option == FIXED_FRAME:
            self.context.frames.fixed_frame = value.strip().lstrip('/')
            self.watch.update()
        elif option == FRAME_RATE:
            self._loop.set_rate(value)
        else:
            look = (self.options[each] for each in (THEME, BACKGROUND, GROUND))
            self._viewers.choose(*look)


def _sections(shown: Visualizer) -> dict[Place, Any]:
    """Return the sections of the file that may have changed."""
    return {
        DISPLAYS: [each.to_file() for each in shown.displays.children],
        OPTIONS_PLACE: shown.options.to_file(),
        PANELS: shown.panels.to_file(),
        SAVED_VIEWS: [view.to_file() for view in shown.saved_views],
        TOOLS: shown.tools.to_file(),
        VIEW: shown.cameras.view.to_file(),
    }
