# SPDX-License-Identifier: Apache-2.0
"""The last seconds of a scene, as one file that shows them anywhere."""

from __future__ import annotations

from html import escape
import time
from typing import Any, cast

import numpy as np
from viser import ViserServer

__all__ = ['SceneTape', 'TooLarge']

REEL_S = 5.0
MESSAGE_BYTES = 1000
"""About what a message costs besides its arrays."""
MIB = 1024 * 1024
TITLE = '<title>Viser</title>'


class TooLarge(ValueError):
    """A scene that is too large for a file, with a sentence."""


class Reel:
    """
    A snapshot of the scene, and what was sent of it since then.

    Parameters
    ----------
    start_s
        The time of the snapshot, of `time.monotonic`.
    scene
        The viser messages that make up the scene.

    Attributes
    ----------
    sent
        The messages sent since then, each with its time of `time.monotonic`.
    size_bytes
        About how much memory these take.

    """

    def __init__(self, start_s: float, scene: list[Any]) -> None:
        self.start_s = start_s
        self.scene = scene
        self.sent: list[tuple[float, Any]] = []
        self.size_bytes = 0


class SceneTape:
    """
    Keeps what is sent of a scene, in reels of some seconds; the oldest ones are thrown away.

    That costs little, because nothing is encoded before it is asked for. The server calls
    `_insert_message` for all that it sends, as it does with its own recordings.

    Parameters
    ----------
    server
        The server of the page.
    span_s
        How much is kept at least if memory allows, in s.
    max_bytes
        About how much memory may be used, in bytes.

    """

    def __init__(self, server: ViserServer, span_s: float, max_bytes: int) -> None:
        self._web = cast(Any, server._websock_server)
        self._span_s = span_s
        self._max_bytes = max_bytes
        self._reels: list[Reel] = []
        with self._web._record_lock:
            self._begin_reel()
            self._web._record_handles.append(self)

    @property
    def size_bytes(self) -> int:
        """Return about how much memory is used."""
        return sum(reel.size_bytes for reel in self._reels)

    @property
    def length_s(self) -> float:
        """Return how many seconds are kept."""
        return time.monotonic() - self._reels[0].start_s

    def look(self) -> None:
        """Throw away what is too old or too much; to be called now and then."""
        with self._web._record_lock:
            now_s = time.monotonic()
            if now_s - self._reels[-1].start_s >= REEL_S:
                self._begin_reel()
            while len(self._reels) > 1 and self._is_spare(now_s):
                del self._reels[0]
            if self.size_bytes > self._max_bytes:
                self._reels.clear()
                self._begin_reel()

    def close(self) -> None:
        """Keep nothing any longer."""
        with self._web._record_lock:
            if self in self._web._record_handles:
                self._web._record_handles.remove(self)

    def page(self, title: str, max_bytes: int) -> bytes:
        """
        Encode what is kept as an HTML page that plays it; takes seconds, so use another thread.

        Parameters
        ----------
        title
            The title of the page.
        max_bytes
            How large it may be, in bytes.

        Returns
        -------
        bytes
            The page, in UTF-8.

        Raises
        ------
        TooLarge
            The page is larger; the text is a sentence.

        """
        with self._web._record_lock:
            scene = self._reels[0].scene
            start_s, end_s = self._reels[0].start_s, time.monotonic()
            sent = [each for reel in self._reels for each in reel.sent]
        html = self._encoded(scene, sent, start_s, end_s)
        page = html.replace(TITLE, f'<title>{escape(title)}</title>', 1).encode()
        if len(page) > max_bytes:
            raise TooLarge(
                f'The page of {end_s - start_s:.0f} s would have {len(page) / MIB:.1f} MiB, and '
                f'no more than {max_bytes / MIB:g} are allowed. Show less, such as no clouds of '
                "points, or allow more: 'Largest Page' in the .rviz file."
            )
        return page

    def _encoded(
        self, scene: list[Any], sent: list[tuple[float, Any]], start_s: float, end_s: float
    ) -> str:
        """Have the server's own recorder encode our messages, and none of those that come now."""
        ours = {id(message) for message in scene} | {id(message) for _, message in sent}
        recorder = self._web.get_message_serializer(lambda message: id(message) in ours)
        for message in scene:
            recorder._insert_message(message)
        for sent_s, message in sent:
            recorder.insert_sleep(max(0.0, sent_s - start_s - recorder._time))
            recorder._insert_message(message)
        recorder.insert_sleep(max(0.0, end_s - start_s - recorder._time))
        page: str = recorder.as_html(dark_mode=True)
        return page

    def _insert_message(self, message: Any) -> None:
        """Take what the server sends."""
        if message.include_in_scene_serialization:
            reel = self._reels[-1]
            reel.sent.append((time.monotonic(), message))
            reel.size_bytes += MESSAGE_BYTES + _array_bytes(vars(message))

    def _begin_reel(self) -> None:
        buffer = self._web.get_message_buffer()
        with buffer.buffer_lock:
            sent = list(buffer.message_from_id.values())
        scene = [message for message in sent if message.include_in_scene_serialization]
        self._reels.append(Reel(time.monotonic(), scene))

    def _is_spare(self, now_s: float) -> bool:
        """Tell if the first reel is not needed, or there is no room for it."""
        is_old = now_s - self._reels[1].start_s >= self._span_s
        return is_old or self.size_bytes > self._max_bytes


def _array_bytes(values: dict[str, Any]) -> int:
    """Return how large the arrays are among some values, and one level below."""
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
