# SPDX-License-Identifier: Apache-2.0
"""What is shown: displays, tools, views and panels, as a file says."""

from __future__ import annotations

from collections.abc import Iterator
import os
from typing import Any, TYPE_CHECKING

from rviz_common.config import ConfigError, Configuration
from rviz_common.config.configuration import (
    DISPLAYS,
    PANELS,
    SAVED_VIEWS,
    TOOLS,
    VIEW,
)
from rviz_common.config.configuration import (
    OPTIONS as OPTIONS_PLACE,
)
from rviz_common.config.document import Place
from rviz_common.context import Context
from rviz_common.frames import Frames
from rviz_common.panels.head import Head
from rviz_common.panels.pace import Pace
from rviz_common.panels.panel_tabs import PanelTabs
from rviz_common.properties import topic_path, Values
from rviz_common.status import Statuses
from rviz_common.views import View
from rviz_common.visualizer.cameras import Cameras, WORLD
from rviz_common.visualizer.entry import Entry
from rviz_common.visualizer.frame_loop import FrameLoop
from rviz_common.visualizer.global_status import FrameWatch
from rviz_common.visualizer.group import Group
from rviz_common.visualizer.making import Maker
from rviz_common.visualizer.options import (
    BACKGROUND,
    FIXED_FRAME,
    FRAME_RATE,
    OPTIONS,
    UNUSED_OPTIONS,
)
from rviz_common.visualizer.reports import sentences_about_classes, sentences_about_displays
from rviz_common.visualizer.tool_box import ToolBox
from rviz_common.work_queue import WorkQueue
from tf2_ros import Buffer, TransformListener

if TYPE_CHECKING:
    from rclpy.node import Node
    from rviz_common.page import Page
    from viser import ViserServer

__all__ = ['Visualizer']


class Visualizer:
    """
    Shows what a file says, in a page.

    All is done in the thread in which the node works, from the moment when it does.
    """

    def __init__(
        self, node: Node, page: Page, configuration: Configuration, path: str = ''
    ) -> None:
        """Show what a configuration says; `path` is the file that it is from."""
        wake = node.create_guard_condition(self._work)
        self._buffer = Buffer()
        self._listener = TransformListener(self._buffer, node)
        frames = Frames(self._buffer)
        self.context = Context(node, page, frames, WorkQueue(wake.trigger), self)
        self.status = Statuses()
        self.watch = FrameWatch(node, frames, self.status)
        self._wake = wake
        self._logger = node.get_logger()
        self._pace = Pace()
        self._maker = Maker(self.context, f'{WORLD}/displays')
        self._open(configuration, path)
        self._loop = FrameLoop(node, self.frame, self.options[FRAME_RATE])

    def load(self, configuration: Configuration, path: str = '') -> None:
        """Show what another file says, and no longer what the last one said."""
        self._close()
        self._open(configuration, path)
        self._loop.set_rate(self.options[FRAME_RATE])

    def save(self, path: str) -> None:
        """Write what is shown to a file, or raise ConfigError."""
        path = os.path.expanduser(path.strip())
        if not path.endswith('.rviz'):
            raise ConfigError(path or 'The file', None, 'Its name must end with .rviz.')
        self.configuration.save(path, self._sections())
        self.path = path
        self._logger.info(f'Saved to {path}.')

    def text(self) -> str:
        """Return what a file of what is shown would have."""
        return self.configuration.text(self._sections())

    def set_option(self, path: str, value: Any) -> None:
        """Set an option, or raise ValueError with the reason."""
        self.options[path] = value
        self._apply(path)

    def add(self, class_name: str, topic: str = '') -> Entry:
        """Add a display of a class with its defaults, or raise LookupError."""
        entry = self._maker.new(class_name)
        path = topic_path(entry.display.PROPERTIES)
        if topic and path:
            entry.display.values[path] = topic
        self.displays.add(entry)
        self.revision += 1
        return entry

    def remove(self, entry: Entry) -> None:
        """Remove a display or a group."""
        if self.displays.remove(entry):
            self.revision += 1

    def frame(self) -> None:
        """Draw the next frame."""
        if self._pace.is_due():
            self.watch.update()
        with self.context.server.atomic():
            self.cameras.update()
            self.displays.update()
            self.head.update()
            self.panels.update()

    def notify(self, title: str, text: str) -> None:
        """Show a message in all browsers, and log it."""
        self._logger.info(f'{title}: {text}')
        for client in self.context.server.get_clients().values():
            client.add_notification(title, text, auto_close_seconds=10.0)

    def close(self) -> None:
        """Show nothing any longer."""
        self._loop.close()
        self._close()
        self._listener.unregister()
        self.context.node.destroy_guard_condition(self._wake)

    def _open(self, configuration: Configuration, path: str) -> None:
        self.configuration, self.path = configuration, path
        self.revision = 0
        self.options = Values(OPTIONS, configuration.options)
        for option in (BACKGROUND, FIXED_FRAME):
            self._apply(option)
        self.cameras = Cameras(self.context, View(configuration.view))
        self.saved_views = [View(each) for each in configuration.saved_views]
        self.displays = Group({}, [self._maker.entry(each) for each in configuration.displays])
        self.tools = ToolBox(self.context, lambda: self.cameras.origin, configuration.tools)
        self.displays.appear(True)
        self.watch.update()
        self.head = Head(self.context, self)
        self.panels = PanelTabs(self.context, configuration.panels)
        for sentence in self._surprises():
            self._logger.warning(sentence)

    def _close(self) -> None:
        self.panels.close()
        self.head.close()
        self.tools.close()
        self.displays.appear(False)
        self.context.scene.remove_by_name(WORLD)

    def _apply(self, option: str) -> None:
        """Make an option take effect."""
        value = self.options[option]
        if option == FIXED_FRAME:
            self.context.frames.fixed_frame = value.strip().lstrip('/')
            self.watch.update()
        elif option == FRAME_RATE:
            self._loop.set_rate(value)
        else:
            _paint(self.context.server, value)

    def _sections(self) -> dict[Place, Any]:
        """Return the sections of the file that may have been changed."""
        return {
            DISPLAYS: self.displays.to_file()['Displays'],
            OPTIONS_PLACE: self.options.to_file(),
            PANELS: self.panels.to_file(),
            SAVED_VIEWS: [view.to_file() for view in self.saved_views],
            TOOLS: self.tools.to_file(),
            VIEW: self.cameras.view.to_file(),
        }

    def _surprises(self) -> Iterator[str]:
        """Return a sentence for all of the file that is not known."""
        source = self.configuration.document.source
        yield from sentences_about_displays(self.configuration, self.displays.children)
        yield from sentences_about_classes('tools', source, self.tools.unknown)
        yield from sentences_about_classes('panels', source, self.panels.unknown)
        view = self.cameras.view
        if not view.is_known:
            yield from sentences_about_classes('views', source, [view.class_name])
        for name in self.options.unknown(UNUSED_OPTIONS):
            yield f"{source}: The global option '{name}' is not known. The file keeps it."
        yield from (f'{source}: The global option {each}' for each in self.options.refusals)

    def _work(self) -> None:
        """Do what widgets have posted."""
        try:
            self.context.queue.run()
        except Exception as error:  # whatever a widget does, all else goes on
            self._logger.error(f'What was entered failed: {type(error).__name__}: {error}')
            self._wake.trigger()  # for what still waits


def _paint(server: ViserServer, color: tuple[int, int, int]) -> None:
    """Give the scene a background of one color."""
    import numpy as np

    server.scene.set_background_image(np.full((1, 1, 3), color, np.uint8), format='png')
