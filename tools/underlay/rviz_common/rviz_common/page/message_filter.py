# SPDX-License-Identifier: Apache-2.0
"""
Filter the messages of browsers: only those that the page itself sends are accepted.

viser trusts each message: a browser could set any attribute of a widget, and one message would
expose the page to the internet. What is wrong is logged, at a limited rate.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Collection
import logging
import math
from typing import Any, Optional

import msgspec
from rviz_common.pace import Pace
from rviz_common.page.uploads import Uploads
from rviz_common.status import described_error
from viser import _messages
from websockets.asyncio.server import ServerConnection
from websockets.exceptions import ConnectionClosed, InvalidHandshake

__all__ = ['LOGGER', 'OptionsOf', 'Strained', 'complain_about_task', 'decoded']

SENT = (
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

LOGGER = logging.getLogger('rviz_common.page')
REPEAT_S = 10.0
_PACE = Pace(REPEAT_S)


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
                _complain(f'A browser has sent what this page does not: {message}')
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


def _complain(sentence: str) -> None:
    """
    Log a warning, unless one has been logged within the last 10 s.

    Parameters
    ----------
    sentence
        The message.

    """
    if _PACE.is_due():
        LOGGER.warning(sentence)


def complain_about_task(loop: asyncio.AbstractEventLoop, about: dict[str, Any]) -> None:
    """
    Log the failure of a task of the page; an exception handler for an asyncio event loop.

    Parameters
    ----------
    loop
        The event loop.
    about
        The context of the failure, with the keys `exception` and `message` of asyncio.

    """
    error = about.get('exception')
    said = described_error(error) if isinstance(error, Exception) else about.get('message', '')
    _complain(f'A message of a browser failed: {said}')


def _shorten(record: logging.LogRecord) -> bool:
    """
    Filter log records, shortening an exception to one line.

    The `websockets` library logs too much, such as clients that do not speak HTTP or disconnect.
    """
    error = record.exc_info[1] if record.exc_info else None
    if isinstance(error, Exception):
        record.msg = f'A connection has failed: {described_error(error)}'
        record.args, record.exc_info = (), None
        return not isinstance(error, (ConnectionClosed, InvalidHandshake))
    return record.levelno >= logging.WARNING


LOGGER.addFilter(_shorten)
