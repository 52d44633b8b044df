# SPDX-License-Identifier: Apache-2.0
"""Recording of the last seconds of the scene, exported as a standalone HTML file."""

from __future__ import annotations

from html import escape
import time
from typing import Any, cast

import numpy as np
from viser import ViserServer

__all__ = ['SceneTape', 'TooLarge']

REEL_S = 5.0
MESSAGE_BYTES = 1000
"""Estimated memory overhead per message, without its arrays."""
MIB = 1024 * 1024
TITLE = '<title>Viser</title>'


class TooLarge(ValueError):
    """Raised, with a message for the user, if a scene is too large for a file."""


class Reel:
    """
    A snapshot of the scene, and the scene messages sent since then.

    Parameters
    ----------
    start_s
        The time of the snapshot, from `time.monotonic`.
    scene
        The viser messages that constitute the scene.

    Attributes
    ----------
    sent
        The messages sent since then, each with its time from `time.monotonic`.
    size_bytes
        The estimated memory used by these messages, in bytes.

    """

    def __init__(self, start_s: float, scene: list[Any]) -> None:
        self.start_s = start_s
        self.scene = scene
        self.sent: list[tuple[float, Any]] = []
        self.size_bytes = 0


class SceneTape:
    """
    Records the messages of a scene in segments of some seconds; the oldest ones are dropped.

    The cost is low, because messages are only encoded on export. The server calls
    `_insert_message` for every message that it sends, as for its own recordings.

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
        self._web = cast(Any, server._websock_server)
        self._span_s = span_s
        self._max_bytes = max_bytes
        self._reels: list[Reel] = []
        with self._web._record_lock:
            self._begin_reel()
            self._web._record_handles.append(self)

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
        """Stop recording."""
        with self._web._record_lock:
            if self in self._web._record_handles:
                self._web._record_handles.remove(self)

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
        """Encode our messages, without concurrent ones, with the serializer of the server."""
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
        """Record a message that the server sends."""
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
        """Check whether the first segment is no longer needed, or exceeds the memory limit."""
        is_old = now_s - self._reels[1].start_s >= self._span_s
        return is_old or self.size_bytes > self._max_bytes


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
