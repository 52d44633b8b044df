# SPDX-License-Identifier: Apache-2.0
"""Widgets to download the recent history of the scene."""

from __future__ import annotations

from datetime import datetime
import threading
from typing import Any

from robot_console.assigning import assign
from robot_console.recordings.scene_tape import SceneTape, TooLarge
from robot_console.recordings.words import size_text
from rviz_common.context import Context
from rviz_common.panels.marks import escaped

__all__ = ['SceneFolder']

MIB = 1024 * 1024
HINT = 'One file that any browser shows, also without a network.'


class SceneFolder:
    """
    Widgets to download the last seconds of the scene as one HTML file.

    Parameters
    ----------
    context
        The context of the panel.
    seconds
        The duration of the scene that is kept, in s.
    max_page_mib
        The maximum size of the file, in MiB; about twice as much is kept in memory.
    is_on
        Whether recording of the scene is on initially.

    """

    def __init__(self, context: Context, seconds: float, max_page_mib: float, is_on: bool) -> None:
        self._context = context
        self._seconds = seconds
        self._max_bytes = int(max_page_mib * MIB)
        self._tape: SceneTape | None = None
        self._is_busy = False
        gui = context.gui
        with gui.add_folder(f'Scene: last {seconds:g} s'):
            self._on: Any = gui.add_checkbox('Keep scene', is_on)
            self._button: Any = gui.add_button('Download as HTML', disabled=True, hint=HINT)
            self._text: Any = gui.add_markdown('', visible=False)
            self._result: Any = gui.add_markdown('', visible=False)
        context.on_input(self._on, self._turn)
        self._button.on_click(lambda event: context.queue.post(lambda: self._make(event.client)))
        self._turn(is_on)

    def update(self) -> None:
        """Update the status of the scene recording."""
        tape = self._tape
        if tape is None:
            return
        tape.look()
        length, size = f'{tape.length_s:.0f} s', size_text(tape.size_bytes)
        assign(self._text, content=f'Keeps {length}: about {size} of memory.', visible=True)
        assign(self._button, disabled=self._is_busy)

    def close(self) -> None:
        """Stop recording the scene, and discard it."""
        if self._tape is not None:
            self._tape.close()
            self._tape = None

    def _turn(self, is_on: bool) -> None:
        self.close()
        if is_on:
            self._tape = SceneTape(self._context.server, self._seconds, 2 * self._max_bytes)
        assign(self._text, visible=is_on)
        assign(self._button, disabled=not is_on or self._is_busy)

    def _make(self, client: Any) -> None:
        """Create the file in a background thread, and send it to the browser that requested it."""
        if self._tape is None or client is None or self._is_busy:
            return
        self._is_busy = True
        assign(self._button, disabled=True)
        assign(self._result, content='Making the file ...', visible=True)
        threading.Thread(target=self._work, args=(self._tape, client), daemon=True).start()

    def _work(self, tape: SceneTape, client: Any) -> None:
        name = datetime.now().strftime('scene_%Y-%m-%d_%H-%M-%S.html')
        try:
            page = tape.page(f'{name}: what RViz has shown', self._max_bytes)
        except TooLarge as error:
            text = f'✖ {escaped(str(error))}'
        except Exception as error:  # whatever is in the scene, the button works again
            text = f'✖ The file cannot be made: {escaped(f"{type(error).__name__}: {error}")}'
        else:
            client.send_file_download(name, page, save_immediately=True)
            text = f'✔ {escaped(name)}: {size_text(len(page))}'
        self._context.queue.post(lambda: self._say(text))

    def _say(self, text: str) -> None:
        self._is_busy = False
        assign(self._result, content=text, visible=True)
        assign(self._button, disabled=self._tape is None)
