# SPDX-License-Identifier: Apache-2.0
"""Clients that speak the protocol of viser, without a browser."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import msgspec
import viser
from websockets.sync.client import ClientConnection, connect
import zstandard

__all__ = ['camera_message', 'connected', 'messages', 'packed', 'stream']


def connected(url: str, **options: Any) -> ClientConnection:
    """Connect to a page as a browser does."""
    return connect(
        url.replace('http://', 'ws://'),
        subprotocols=[f'viser-v{viser.__version__}'],  # type: ignore[list-item]
        compression=None,
        max_size=None,
        **options,
    )


def messages(frame: bytes | str) -> list[dict[str, Any]]:
    """Return the messages that a frame of the websocket has."""
    assert isinstance(frame, bytes)
    length = int.from_bytes(frame[8:16], 'little')
    text = zstandard.decompress(frame[16 : 16 + length])
    return list(msgspec.msgpack.decode(text)['messages'])


def stream(connection: ClientConnection, timeout_s: float) -> Iterator[dict[str, Any]]:
    """Yield the messages that come."""
    while True:
        yield from messages(connection.recv(timeout=timeout_s))


def packed(message: Any) -> bytes:
    """Return a message as a browser sends it."""
    return msgspec.msgpack.encode(message)


def camera_message() -> dict[str, Any]:
    """Return what a browser says first: how it looks at the scene."""
    return {
        'type': 'ViewerCameraMessage',
        'wxyz': [1.0, 0.0, 0.0, 0.0],
        'position': [3.0, 0.0, 1.0],
        'fov': 0.8,
        'near': 0.01,
        'far': 1000.0,
        'image_height': 600,
        'image_width': 800,
        'look_at': [0.0, 0.0, 0.0],
        'up_direction': [0.0, 0.0, 1.0],
    }
