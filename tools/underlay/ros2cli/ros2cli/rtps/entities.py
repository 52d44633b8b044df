# SPDX-License-Identifier: Apache-2.0
"""Assignment of endpoints to nodes: messages of the topic `ros_discovery_info`."""

from __future__ import annotations

import struct
from typing import NamedTuple

from ros2cli.rtps.text import text_of

TOPIC = 'ros_discovery_info'
TYPE_NAME = 'rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_'
GID_BYTES = 16
ENCAPSULATION_BYTES = 4


class NodeEntities(NamedTuple):
    """A node and the GUIDs of its endpoints."""

    namespace: str
    name: str
    readers: frozenset[bytes]
    writers: frozenset[bytes]


def decode_entities(payload: bytes) -> tuple[NodeEntities, ...]:
    """
    Decode a rmw_dds_common/msg/ParticipantEntitiesInfo.

    Parameters
    ----------
    payload
        The serialized message (CDR), with its encapsulation header.

    Returns
    -------
    tuple of NodeEntities
        The nodes of the participant with their endpoints.

    Raises
    ------
    ValueError
        The message is damaged.

    """
    try:
        cursor = _Cursor(payload)
        return tuple(cursor.node() for _ in range(cursor.length()))
    except struct.error as error:
        raise ValueError(f'damaged ParticipantEntitiesInfo: {error}') from error


class _Cursor:
    """CDR (version 1) reader that starts after the participant's own GUID."""

    def __init__(self, payload: bytes) -> None:
        self._data = payload[ENCAPSULATION_BYTES:]
        self._order = '<' if payload[1:2] == b'\x01' else '>'
        self._offset = GID_BYTES

    def node(self) -> NodeEntities:
        return NodeEntities(self._text(), self._text(), self._gids(), self._gids())

    def length(self) -> int:
        self._offset += -self._offset % 4
        (number,) = struct.unpack_from(f'{self._order}I', self._data, self._offset)
        self._offset += 4
        return int(number)

    def _text(self) -> str:
        return text_of(self._take(self.length()))

    def _gids(self) -> frozenset[bytes]:
        return frozenset(self._take(GID_BYTES) for _ in range(self.length()))

    def _take(self, size: int) -> bytes:
        start, end = self._offset, self._offset + size
        if end > len(self._data):
            raise ValueError(f'{end - len(self._data)} bytes are missing')
        taken = self._data[start:end]
        self._offset = end
        return taken
