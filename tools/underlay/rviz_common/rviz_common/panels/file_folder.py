# SPDX-License-Identifier: Apache-2.0
"""Widgets to save and load configuration files."""

from __future__ import annotations

import os
from typing import Any, TYPE_CHECKING

from rviz_common.config import ConfigError, Configuration
from rviz_common.config.configuration import LARGEST, TOO_LARGE
from rviz_common.context import Context
from rviz_common.pace import Pace
from rviz_common.panels.marks import printable
from rviz_common.panels.order import FILE_ORDER

if TYPE_CHECKING:
    from viser._messages import FileTransferStartUpload

__all__ = ['FileFolder']

REFUSAL_PERIOD_S = 1.0
LONGEST_NAME = 100


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
            save = gui.add_button('Save', hint='Write what is shown to this file.')
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
            self._visualizer.notify('Not loaded', f'{name}: The file is no text: {error}.')
        except ConfigError as error:
            self._visualizer.notify('Not loaded', str(error))
        else:
            directory = os.path.dirname(self._path.value)
            self._path.value = os.path.join(directory, os.path.basename(name))
            self._visualizer.load(configuration, self._path.value)
