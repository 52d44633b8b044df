# SPDX-License-Identifier: Apache-2.0
"""How the last seconds of the scene are kept, and downloaded as a standalone HTML file."""

from __future__ import annotations

from collections.abc import Iterable
from datetime import datetime
from html import escape
import threading
import time
from typing import Any

import numpy as np
from robot_console.recordings.widgets import assign, size_text
from rviz_common.context import Context
from rviz_common.page.viser_connection import connection_of
from rviz_common.status import escaped
from viser import ViserServer
from viser.infra import WebsockMessageHandler

__all__ = ['SceneFolder', 'SceneTape', 'TooLarge']

REEL_S = 5.0
MESSAGE_BYTES = 1000
"""Estimated memory overhead per message, without its arrays."""
MIB = 1024 * 1024
TITLE = '<title>Viser</title>'

HINT = 'One file that opens in any browser, even offline.'


class TooLarge(ValueError):
    """Raised, with a message for the user, if a scene is too large for a file."""


class Reel:
    """
    A snapshot of the scene, and the scene messages sent since then.

    The cost is low, because messages are only encoded on export: the recorder of viser gets each
    message in its filter, which keeps it here.

    Parameters
    ----------
    web
        The connection to browsers.

    Attributes
    ----------
    start_s
        The time of the snapshot, from `time.monotonic`.
    scene
        The viser messages that constitute the scene.
    sent
        The messages sent since then, each with its time from `time.monotonic`.
    size_bytes
        The estimated memory used by these messages, in bytes.

    """

    def __init__(self, web: WebsockMessageHandler) -> None:
        self.start_s = time.monotonic()
        self.sent: list[tuple[float, Any]] = []
        self.size_bytes = 0
        # What is sent from here on until the snapshot is in both, and shown once more at worst.
        self._recorder = web.get_message_serializer(self._keep)
        buffer = web.get_message_buffer()
        with buffer.buffer_lock:
            known = list(buffer.message_from_id.values())
        self.scene = [message for message in known if message.include_in_scene_serialization]

    def end(self) -> None:
        """Stop recording; what was recorded stays."""
        self._recorder.serialize()  # nothing; viser has no other way to end a recording

    def _keep(self, message: Any) -> bool:
        """Record a message that the server sends; return that viser does not have to."""
        if message.include_in_scene_serialization:
            self.sent.append((time.monotonic(), message))
            self.size_bytes += MESSAGE_BYTES + _array_bytes(vars(message))
        return False


class SceneTape:
    """
    Records the messages of a scene in segments of some seconds; the oldest ones are dropped.

    Parameters
    ----------
    server
        The server of the page.
    span_s
        The minimum duration to keep if memory allows, in s.
    max_bytes
        The approximate maximum memory, in bytes.

    """

    def __init__(self, server: ViserServer, span_s: float, max_bytes: int) -> None:
        self._web = connection_of(server.gui)
        self._span_s = span_s
        self._max_bytes = max_bytes
        self._lock = threading.Lock()
        self._reels = [Reel(self._web)]
        self._is_closed = False

    @property
    def size_bytes(self) -> int:
        """Return the estimated memory use, in bytes."""
        return sum(reel.size_bytes for reel in self._reels)

    @property
    def length_s(self) -> float:
        """Return the recorded duration, in s."""
        return time.monotonic() - self._reels[0].start_s

    def look(self) -> None:
        """Drop segments that are too old or exceed the memory limit; call periodically."""
        with self._lock:
            now_s = time.monotonic()
            if now_s - self._reels[-1].start_s >= REEL_S:
                self._begin_reel()
            while len(self._reels) > 1 and self._is_spare(now_s):
                del self._reels[0]
            if self.size_bytes > self._max_bytes:
                self._begin_reel()
                del self._reels[:-1]

    def close(self) -> None:
        """Stop recording."""
        with self._lock:
            if not self._is_closed:
                self._is_closed = True
                self._reels[-1].end()

    def page(self, title: str, max_bytes: int) -> bytes:
        """
        Encode the recording as an HTML page that plays it; takes seconds, so use another thread.

        Parameters
        ----------
        title
            The title of the page.
        max_bytes
            The maximum size of the page, in bytes.

        Returns
        -------
        bytes
            The page, encoded in UTF-8.

        Raises
        ------
        TooLarge
            The page exceeds the maximum size; the message is a full sentence.

        """
        with self._lock:
            scene = self._reels[0].scene
            start_s, end_s = self._reels[0].start_s, time.monotonic()
            sent = _once(each for reel in self._reels for each in list(reel.sent))
        html = self._encoded(scene, sent, start_s, end_s)
        page = html.replace(TITLE, f'<title>{escape(title)}</title>', 1).encode()
        if len(page) > max_bytes:
            raise TooLarge(
                f'The page of {end_s - start_s:.0f} s would have {len(page) / MIB:.1f} MiB, but '
                f'no more than {max_bytes / MIB:g} are allowed. Show less, such as no point '
                "clouds, or raise the limit: 'Largest Page' in the .rviz file."
            )
        return page

    def _encoded(
        self, scene: list[Any], sent: list[tuple[float, Any]], start_s: float, end_s: float
    ) -> str:
        """Encode our messages, without concurrent ones, with the serializer of the server."""
        ours = {id(message) for message in scene} | {id(message) for _, message in sent}
        recorder = self._web.get_message_serializer(lambda message: id(message) in ours)
        insert = recorder._insert_message
        for message in scene:
            insert(message)
        last_s = start_s
        for sent_s, message in sent:
            recorder.insert_sleep(max(0.0, sent_s - last_s))
            last_s = max(last_s, sent_s)
            insert(message)
        recorder.insert_sleep(max(0.0, end_s - last_s))
        page: str = recorder.as_html(dark_mode=True)
        return page

    def _begin_reel(self) -> None:
        """Begin another segment, before the last one ends: no message is lost in between."""
        self._reels.append(Reel(self._web))
        self._reels[-2].end()

    def _is_spare(self, now_s: float) -> bool:
        """Check whether the first segment is no longer needed, or exceeds the memory limit."""
        is_old = now_s - self._reels[1].start_s >= self._span_s
        return is_old or self.size_bytes > self._max_bytes


def _once(sent: Iterable[tuple[float, Any]]) -> list[tuple[float, Any]]:
    """Leave out what the next segment has recorded, too, before the one before ended."""
    first: dict[int, tuple[float, Any]] = {}
    for each in sent:
        first.setdefault(id(each[1]), each)
    return list(first.values())


def _array_bytes(values: dict[str, Any]) -> int:
    """Return the total size of arrays and bytes, including nested values."""
    size = 0
    for value in values.values():
        if isinstance(value, np.ndarray):
            size += value.nbytes
        elif isinstance(value, bytes):
            size += len(value)
        elif isinstance(value, dict):
            size += _array_bytes(value)
        elif hasattr(value, '__dict__'):
            size += _array_bytes(vars(value))
    return size


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
        assign(self._result, content='Creating the file ...', visible=True)
        threading.Thread(target=self._work, args=(self._tape, client), daemon=True).start()

    def _work(self, tape: SceneTape, client: Any) -> None:
        name = datetime.now().strftime('scene_%Y-%m-%d_%H-%M-%S.html')
        try:
            page = tape.page(f'{name}: what RViz has shown', self._max_bytes)
        except TooLarge as error:
            text = f'✖ {escaped(str(error))}'
        except Exception as error:  # whatever is in the scene, the button works again
            text = f'✖ The file cannot be created: {escaped(f"{type(error).__name__}: {error}")}'
        else:
            client.send_file_download(name, page, save_immediately=True)
            text = f'✔ {escaped(name)}: {size_text(len(page))}'
        self._context.queue.post(lambda: self._say(text))

    def _say(self, text: str) -> None:
        self._is_busy = False
        assign(self._result, content=text, visible=True)
        assign(self._button, disabled=self._tape is None)
