# SPDX-License-Identifier: Apache-2.0
"""
Filter the messages of browsers: only those that the page itself sends are accepted.

viser trusts each message: a browser could set any attribute of a widget, and one message would
expose the page to the internet. What is wrong is logged, at a limited rate.

Uploads are limited, which viser keeps in memory until a file is complete. A browser announces a
file with its size and the count of its parts, then sends the parts without waiting for an answer.
Any client of the page can announce any number of files, of any size: parts of a file that was
rejected, or that was never announced, are dropped as they arrive.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass, field
import math
from typing import Any, Optional

import msgspec
from rviz_common.page.connection_log import complain
from viser import _messages
from viser._messages import FileTransferPart, FileTransferStartUpload
from websockets.asyncio.server import ServerConnection

__all__ = [
    'LARGEST_UPLOAD_BYTES',
    'OptionsOf',
    'Strained',
    'Uploads',
    'decoded',
]

SENT = (
    _messages.CommandTriggerMessage,
    _messages.FileTransferPart,
    _messages.FileTransferPartAck,
    _messages.FileTransferStartUpload,
    _messages.GuiButtonHoldMessage,
    _messages.GuiUpdateMessage,
    _messages.SceneNodeClickMessage,
    _messages.SceneNodeDragMessage,
    _messages.ScenePointerMessage,
    _messages.ViewerCameraMessage,
)
DECODERS = {kind.__name__: msgspec.msgpack.Decoder(kind, strict=False) for kind in SENT}
FIELDS = {kind.__name__: {'type', *kind.__dataclass_fields__} for kind in SENT}
LONGEST_NAME = 40
OptionsOf = Callable[[str], Optional[Collection[str]]]
"""Accepts the id of a widget; returns its options, None if it is not a choice widget."""

LARGEST_UPLOAD_BYTES = 10_000_000
"""The maximum size of a file; a configuration has a few thousand bytes."""
MOST_PARTS = 200
MOST_AT_ONCE = 4
MEGA = 1_000_000

Refusal = Callable[[FileTransferStartUpload, str], None]


class Strained:
    """
    A connection whose `recv` returns only valid messages of the page; others are dropped.

    Everything else is delegated to the connection.

    Parameters
    ----------
    connection
        The connection to a browser.
    uploads
        Limits the files that it uploads.
    options_of
        Returns the options of a widget, so that only values that it offers are accepted.

    """

    def __init__(
        self, connection: ServerConnection, uploads: Uploads, options_of: OptionsOf
    ) -> None:
        self._connection = connection
        self._uploads = uploads
        self._options_of = options_of

    def __getattr__(self, name: str) -> Any:
        """Return any other attribute of the connection."""
        return getattr(self._connection, name)

    async def recv(self) -> bytes | str:
        """Return the next valid message of the page."""
        while True:
            received = await self._connection.recv()
            message = decoded(received)
            if not isinstance(message, str) and not self._is_offered(message):
                continue
            if isinstance(message, str):
                complain(f'A browser sent an unexpected message: {message}')
            elif self._uploads.admits(message, self):
                return received

    def _is_offered(self, message: _messages.Message) -> bool:
        """Whether a choice widget offers the value; its options may just have changed."""
        if not isinstance(message, _messages.GuiUpdateMessage):
            return True
        options = self._options_of(message.uuid)
        return options is None or message.updates['value'] in options


def decoded(received: bytes | str) -> _messages.Message | str:
    """
    Decode a message, and validate that the page sends such messages.

    Parameters
    ----------
    received
        A frame of the WebSocket; only binary ones are valid.

    Returns
    -------
    _messages.Message | str
        The message, or a description of what is wrong with it.

    """
    if not isinstance(received, bytes):
        return 'a text'
    try:
        fields = msgspec.msgpack.decode(received)
        name = fields.get('type') if isinstance(fields, dict) else None
        if not isinstance(name, str) or name not in DECODERS:
            return f'a message of the type {ascii(name)[:LONGEST_NAME]}'
        message = DECODERS[name].decode(received)
    except (ValueError, RecursionError) as error:
        return ascii(str(error))
    if not fields.keys() <= FIELDS[name]:
        return f'a {name} with unknown fields'
    if isinstance(message, _messages.GuiUpdateMessage) and message.updates.keys() != {'value'}:
        return 'properties of a widget other than its value'
    return message if _is_finite(fields) else f'a {name} with numbers that are not finite'


def _is_finite(value: Any) -> bool:
    if isinstance(value, float):
        return math.isfinite(value)
    if isinstance(value, dict):
        return all(map(_is_finite, value.values()))
    return not isinstance(value, (list, tuple)) or all(map(_is_finite, value))


@dataclass
class _Upload:
    """An upload in progress: its owner, and the parts that are still missing."""

    owner: object
    bytes_left: int
    parts_left: set[int] = field(default_factory=set)


class Uploads:
    """Admits files to a page: each of limited size, and few at a time."""

    def __init__(self) -> None:
        self._running: dict[str, _Upload] = {}
        self.on_refusal: Refusal = lambda start, sentence: None
        """Called in the page's thread with the announcement of a rejected file and the reason."""

    def admits(self, message: object, owner: object) -> bool:
        """
        Check whether to handle a message; messages that belong to no upload always are.

        Parameters
        ----------
        message
            A message of viser, decoded.
        owner
            The connection that it arrived on; `leave` drops its uploads.

        """
        if isinstance(message, FileTransferStartUpload):
            return self._starts(message, owner)
        if isinstance(message, FileTransferPart):
            return self._continues(message, owner)
        return True

    def leave(self, owner: object) -> None:
        """
        Drop the uploads of a connection that has ended.

        Parameters
        ----------
        owner
            The connection, as given to `admits`.

        """
        for key in [key for key, each in self._running.items() if each.owner is owner]:
            del self._running[key]

    def _starts(self, start: FileTransferStartUpload, owner: object) -> bool:
        reason = self._objection(start, owner)
        if reason:
            self.on_refusal(start, reason)
            return False
        if start.part_count:
            parts = set(range(start.part_count))
            self._running[start.transfer_uuid] = _Upload(owner, start.size_bytes, parts)
        return True

    def _objection(self, start: FileTransferStartUpload, owner: object) -> str:
        """Return the reason why a file is rejected, or ''."""
        if start.size_bytes > LARGEST_UPLOAD_BYTES:
            return (
                f'The file has {start.size_bytes / MEGA:.1f} MB, but the limit for files '
                f'loaded here is {LARGEST_UPLOAD_BYTES // MEGA} MB. Choose a file that RViz has '
                'saved.'
            )
        if not (0 <= start.size_bytes and 0 <= start.part_count <= MOST_PARTS):
            return 'The size of the file is not valid. Reload the page, and try again.'
        is_known = start.transfer_uuid in self._running
        if is_known or any(each.owner is owner for each in self._running.values()):
            return 'This page is already uploading a file. Wait for it, or reload the page.'
        if len(self._running) >= MOST_AT_ONCE:
            return f'{MOST_AT_ONCE} files are already being uploaded. Try again in a moment.'
        return ''

    def _continues(self, part: FileTransferPart, owner: object) -> bool:
        upload = self._running.get(part.transfer_uuid)
        if upload is None or upload.owner is not owner or part.part_index not in upload.parts_left:
            return False
        upload.parts_left.remove(part.part_index)
        upload.bytes_left -= len(part.content)
        if upload.bytes_left < 0:
            return False  # with parts missing from now on, the file is never completed
        if not upload.parts_left:
            del self._running[part.transfer_uuid]
        return True
