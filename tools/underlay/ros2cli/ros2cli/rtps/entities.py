# SPDX-License-Identifier: Apache-2.0
"""
Nodes and their readers and writers, as their participants describe them (8.5.4.4, 9.6.2.2).

Readers and writers come from endpoint discovery, the nodes that own them from messages of the
topic `ros_discovery_info`.
"""

from __future__ import annotations

import struct
from typing import NamedTuple

from ros2cli.rtps.identifiers import (
    PID_DEADLINE,
    PID_DURABILITY,
    PID_ENDPOINT_GUID,
    PID_KEY_HASH,
    PID_LIFESPAN,
    PID_LIVELINESS,
    PID_RELIABILITY,
    PID_TOPIC_NAME,
    PID_TYPE_NAME,
    PID_USER_DATA,
)
from ros2cli.rtps.parameters import Parameters, text_of

TOPIC = 'ros_discovery_info'
TYPE_NAME = 'rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_'
ENCAPSULATION_BYTES = 4
BEST_EFFORT, RELIABLE = 1, 2
VOLATILE, TRANSIENT_LOCAL = 0, 1
AUTOMATIC, MANUAL_BY_TOPIC = 0, 2
GUID_BYTES = 16


class Qos(NamedTuple):
    """Quality of service as DDS enumerators; durations in nanoseconds."""

    reliability: int
    durability: int
    liveliness: int
    lease_ns: int
    deadline_ns: int
    lifespan_ns: int


class Endpoint(NamedTuple):
    """
    A reader or writer.

    :param guid: 16 bytes
    :param topic: name in DDS, with the prefix added by ROS
    :param type_name: name in DDS
    :param type_hash: REP-2016 string such as `RIHS01_...`, or ''
    """

    guid: bytes
    is_writer: bool
    topic: str
    type_name: str
    type_hash: str
    qos: Qos


def guid_of(parameters: Parameters) -> bytes:
    """
    Return the GUID (16 bytes) of an endpoint.

    Parameters
    ----------
    parameters : Parameters
        The description of the endpoint, or only its key.

    Raises
    ------
    ValueError
        There is no GUID, or it is damaged.

    """
    raw = parameters.first(PID_ENDPOINT_GUID) or parameters.first(PID_KEY_HASH)
    if len(raw) != GUID_BYTES:
        raise ValueError('an endpoint without identity')
    return raw


def endpoint_of(parameters: Parameters, *, is_writer: bool) -> Endpoint:
    """
    Decode an endpoint; missing parameters have the DDS defaults.

    Parameters
    ----------
    parameters : Parameters
        The description of the endpoint.
    is_writer
        Whether it is a writer, whose default reliability differs from that of a reader.

    Raises
    ------
    ValueError
        The description is damaged.

    """
    reliability = RELIABLE if is_writer else BEST_EFFORT
    return Endpoint(
        guid_of(parameters),
        is_writer,
        parameters.text(PID_TOPIC_NAME),
        parameters.text(PID_TYPE_NAME),
        _type_hash(parameters.octets(PID_USER_DATA)),
        Qos(
            parameters.number(PID_RELIABILITY, reliability),
            parameters.number(PID_DURABILITY, VOLATILE),
            parameters.number(PID_LIVELINESS, AUTOMATIC),
            parameters.duration_ns(PID_LIVELINESS, offset=4),
            parameters.duration_ns(PID_DEADLINE),
            parameters.duration_ns(PID_LIFESPAN),
        ),
    )


def _type_hash(user_data: bytes) -> str:
    for pair in user_data.decode('ascii', 'replace').split(';'):
        key, _, value = pair.partition('=')
        if key == 'typehash':
            return value
    return ''


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
        self._offset = GUID_BYTES

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
        return frozenset(self._take(GUID_BYTES) for _ in range(self.length()))

    def _take(self, size: int) -> bytes:
        start, end = self._offset, self._offset + size
        if end > len(self._data):
            raise ValueError(f'{end - len(self._data)} bytes are missing')
        taken = self._data[start:end]
        self._offset = end
        return taken
