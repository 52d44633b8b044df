# SPDX-License-Identifier: Apache-2.0
"""
Filter the messages of browsers: only those that the page itself sends are accepted.

viser trusts each message: a browser could set any attribute of a widget, and one message would
expose the page to the internet.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
import math
from typing import Any, Optional

import msgspec
from rviz_common.page.complaints import complain
from rviz_common.page.uploads import Uploads
from viser import _messages
from websockets.asyncio.server import ServerConnection

__all__ = ['OptionsOf', 'Strained', 'decoded']

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
                complain(f'A browser has sent what this page does not: {message}')
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
        return f'a {name} with too much in it'
    if isinstance(message, _messages.GuiUpdateMessage) and message.updates.keys() != {'value'}:
        return 'other properties of a widget than its value'
    return message if _is_finite(fields) else f'a {name} with numbers that are not finite'


def _is_finite(value: Any) -> bool:
    if isinstance(value, float):
        return math.isfinite(value)
    if isinstance(value, dict):
        return all(map(_is_finite, value.values()))
    return not isinstance(value, (list, tuple)) or all(map(_is_finite, value))
