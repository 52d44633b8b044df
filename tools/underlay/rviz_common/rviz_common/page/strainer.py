# SPDX-License-Identifier: Apache-2.0
"""
Let only those messages of browsers pass that a page sends.

viser takes each message to be right: of a widget a browser could set whatever it likes, and one
message would make the page known to the internet.
"""

from __future__ import annotations

import math
from typing import Any

import msgspec
from rviz_common.page.complaints import complain
from viser import _messages
from websockets.asyncio.server import ServerConnection

__all__ = ['Strained', 'objection']

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


class Strained:
    """A connection that gives out only messages that a page sends; others are left out."""

    def __init__(self, connection: ServerConnection) -> None:
        """Take the connection to a browser."""
        self._connection = connection

    def __getattr__(self, name: str) -> Any:
        """Return what else the connection has."""
        return getattr(self._connection, name)

    async def recv(self) -> bytes | str:
        """Return the next message that a page sends."""
        while True:
            received = await self._connection.recv()
            reason = objection(received)
            if not reason:
                return received
            complain(f'A browser has sent what this page does not: {reason}')


def objection(received: bytes | str) -> str:
    """Return why no page sends this, or '' if one does."""
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
    return '' if _is_finite(fields) else f'a {name} with numbers that are not finite'


def _is_finite(value: Any) -> bool:
    if isinstance(value, float):
        return math.isfinite(value)
    if isinstance(value, dict):
        return all(map(_is_finite, value.values()))
    return not isinstance(value, (list, tuple)) or all(map(_is_finite, value))
