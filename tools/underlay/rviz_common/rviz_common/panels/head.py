# SPDX-License-Identifier: Apache-2.0
"""The head of the page: a status summary, the configuration file, and the tools."""

from __future__ import annotations

import os
from typing import Any, TYPE_CHECKING

from rviz_common.config import ConfigError, Configuration
from rviz_common.config.configuration import LARGEST, TOO_LARGE
from rviz_common.context import Context
from rviz_common.pace import Pace
from rviz_common.status import escaped, Level, MARKS, printable
from rviz_common.tool import Tool
from rviz_common.widget_order import FILE_ORDER, STATUS_ORDER, TOOLS_ORDER

if TYPE_CHECKING:
    from rviz_common.visualizer.visualizer import Visualizer
    from viser._messages import FileTransferStartUpload

__all__ = ['FileFolder', 'Head']

NAMED = 3
MOVE = 'Move Camera'

REFUSAL_PERIOD_S = 1.0
LONGEST_NAME = 100


class Head:
    """
    The status at a glance, and a button for each tool, at the top of the page.

    Parameters
    ----------
    context
        The page.
    visualizer
        Provides the status, the displays and the tools.

    """

    def __init__(self, context: Context, visualizer: Visualizer) -> None:
        self._visualizer = visualizer
        self._pace = Pace()
        self._text = context.gui.add_markdown('', order=STATUS_ORDER)
        self._folder = context.gui.add_folder(
            'Tools',
            order=TOOLS_ORDER,
            visible=bool(visualizer.tools.tools),
            expand_by_default=False,
        )
        self._buttons: list[tuple[Tool | None, Any]] = []
        with self._folder:
            for tool in (None, *visualizer.tools.tools):
                self._buttons.append((tool, self._button(context, tool)))
            self._hint = context.gui.add_markdown('', visible=False)
        self._shown: Any = _MISSING

    def update(self) -> None:
        """Update the widgets."""
        in_use = self._visualizer.tools.in_use
        if in_use is not self._shown:
            self._shown = in_use
            self._mark(in_use)
        if self._pace.is_due():
            text = self._summary()
            if text != self._text.content:
                self._text.content = text

    def close(self) -> None:
        """Remove the widgets."""
        self._text.remove()
        self._folder.remove()

    def _button(self, context: Context, tool: Tool | None) -> Any:
        name = MOVE if tool is None else tool.NAME
        hint = 'Drag to rotate the scene.' if tool is None else tool.HINT
        button = context.gui.add_button(name, hint=hint, color='gray')
        context.on_click(button, lambda: self._visualizer.tools.use(tool))
        return button

    def _mark(self, in_use: Tool | None) -> None:
        for tool, button in self._buttons:
            button.color = 'blue' if tool is in_use else 'gray'
        self._hint.visible = in_use is not None
        if in_use is not None:
            self._hint.content = in_use.HINT

    def _summary(self) -> str:
        """Summarise the status, the worst first."""
        visualizer = self._visualizer
        lines = [
            f'{MARKS[level]} **{subject}**: {escaped(sentence)}'
            for subject, level, sentence in visualizer.status.items()
            if level
        ]
        bad = [
            each for each in visualizer.displays.walk() if each.is_enabled and each.status.level
        ]
        for level in (Level.ERROR, Level.WARN):
            names = [escaped(each.name) for each in bad if each.level is level]
            if names:
                more = f' and {len(names) - NAMED} more' if len(names) > NAMED else ''
                lines.append(f'{MARKS[level]} {", ".join(names[:NAMED])}{more}: see Displays')
        return '\n\n'.join(lines) or f'{MARKS[Level.OK]} No display problems.'


_MISSING = object()


class FileFolder:
    """
    Widgets to save the configuration to a file, to download it, and to load another one.

    Parameters
    ----------
    context
        The page, and the visualizer that saves and loads.

    """

    def __init__(self, context: Context) -> None:
        self._context = context
        self._visualizer = context.visualizer
        path = self._visualizer.path or os.path.join(os.getcwd(), 'saved.rviz')
        gui = context.gui
        # It is kept when a file is loaded: viser fails if the button is removed meanwhile.
        self._folder = gui.add_folder('File', order=FILE_ORDER, expand_by_default=False)
        with self._folder:
            self._path: Any = gui.add_text(
                'Path', printable(path), hint='On the machine where rviz2 runs.'
            )
            save = gui.add_button('Save', hint='Save the configuration to this file.')
            download = gui.add_button('Download', hint='Save it where the browser runs.')
            upload = gui.add_upload_button('Load a .rviz file', mime_type='*/*')
        context.on_click(save, self._save)
        download.on_click(lambda event: context.queue.post(lambda: self._download(event.client)))
        upload.on_upload(self._on_upload)
        self._pace = Pace(REFUSAL_PERIOD_S)
        context.page.uploads.on_refusal = self._on_refusal

    def close(self) -> None:
        """Remove the widgets."""
        self._folder.remove()

    def _save(self) -> None:
        try:
            self._visualizer.save(self._path.value)
        except ConfigError as error:
            self._visualizer.notify('Not saved', str(error))
        else:
            self._visualizer.notify('Saved', self._visualizer.path)

    def _download(self, client: Any) -> None:
        name = os.path.basename(self._path.value) or 'saved.rviz'
        if client is not None:
            client.send_file_download(name, self._visualizer.text().encode())

    def _on_upload(self, event: Any) -> None:
        file = event.target.value
        self._context.queue.post(lambda: self._load(file.name, file.content))

    def _on_refusal(self, start: FileTransferStartUpload, sentence: str) -> None:
        """Report a rejected file, at a limited rate, as a client may flood the page with files."""
        if self._pace.is_due():
            self._context.queue.post(lambda: self._refuse(start, sentence))

    def _refuse(self, start: FileTransferStartUpload, sentence: str) -> None:
        self._context.page.end_upload(start)
        self._visualizer.notify('Not loaded', f'{start.filename[:LONGEST_NAME]}: {sentence}')

    def _load(self, name: str, content: bytes) -> None:
        try:
            if len(content) > LARGEST:
                raise ConfigError(name, None, TOO_LARGE)
            configuration = Configuration.parse(content.decode(), name)
        except UnicodeDecodeError as error:
            self._visualizer.notify('Not loaded', f'{name}: The file is not a text file: {error}.')
        except ConfigError as error:
            self._visualizer.notify('Not loaded', str(error))
        else:
            directory = os.path.dirname(self._path.value)
            self._path.value = os.path.join(directory, os.path.basename(name))
            self._visualizer.load(configuration, self._path.value)
