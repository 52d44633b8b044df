# SPDX-License-Identifier: Apache-2.0
"""Datagrams that we send (8.3, 9.4)."""

from __future__ import annotations

import struct

from ros2cli.rtps.identifiers import PROTOCOL_VERSION, VENDOR_UNKNOWN
from ros2cli.rtps.wire import (
    ACKNACK,
    DATA,
    HEARTBEAT,
    INFO_DESTINATION,
    INLINE_QOS,
    KEY,
    LITTLE_ENDIAN,
    MAGIC,
    MAX_NUMBERS,
    PAYLOAD,
)

FINAL = 0b0010


def message(own_prefix: bytes, *parts: bytes) -> bytes:
    """
    Build a datagram from submessages.

    Parameters
    ----------
    own_prefix
        Our GUID prefix (12 bytes).
    *parts
        The submessages.

    """
    return b''.join((MAGIC, PROTOCOL_VERSION, VENDOR_UNKNOWN, own_prefix, *parts))


def info_destination(prefix: bytes) -> bytes:
    """
    Build an INFO_DST submessage, which names the receiver of the submessages that follow.

    Parameters
    ----------
    prefix
        The GUID prefix (12 bytes) of the receiver.

    """
    return _submessage(INFO_DESTINATION, 0, prefix)


def data(reader: bytes, writer: bytes, number: int, payload: bytes, key_qos: bytes = b'') -> bytes:
    """
    Build a DATA submessage, which carries a sample.

    Parameters
    ----------
    reader, writer
        The entity IDs (4 bytes each) of both ends.
    number
        The sequence number of the sample.
    payload
        The serialized sample, with its encapsulation header.
    key_qos
        Inline QoS parameters; with them the payload is only the key.

    """
    flags = INLINE_QOS | KEY if key_qos else PAYLOAD
    ends = struct.pack('<HH', 0, 16) + reader + writer
    return _submessage(DATA, flags, ends + _sequence_number(number) + key_qos + payload)


def heartbeat(reader: bytes, writer: bytes, first: int, last: int, count: int) -> bytes:
    """
    Build a HEARTBEAT submessage, which announces samples and requests an ACKNACK.

    Parameters
    ----------
    reader, writer
        The entity IDs (4 bytes each) of both ends.
    first, last
        The range of sequence numbers that the writer has.
    count
        The number of this heartbeat, by which duplicates are recognized.

    """
    numbers = _sequence_number(first) + _sequence_number(last)
    return _submessage(HEARTBEAT, 0, reader + writer + numbers + struct.pack('<I', count))


def acknack(reader: bytes, writer: bytes, base: int, missing: list[int], count: int) -> bytes:
    """
    Build an ACKNACK submessage, which acknowledges samples and requests missing ones.

    Parameters
    ----------
    reader, writer
        The entity IDs (4 bytes each) of both ends.
    base
        All samples before this sequence number have been received; 0 only requests a heartbeat.
    missing
        The sequence numbers to request, from `base` on; those at `base` + 256 or later are left
        out.
    count
        The number of this message, by which duplicates are recognized.

    """
    flags = 0 if missing or not base else FINAL
    wanted = [number - base for number in missing if number - base < MAX_NUMBERS]
    size = max(wanted) + 1 if wanted else 0
    words = [0] * ((size + 31) // 32)
    for i in wanted:
        words[i // 32] |= 1 << (31 - i % 32)
    numbers = _sequence_number(base) + struct.pack(f'<I{len(words)}I', size, *words)
    return _submessage(ACKNACK, flags, reader + writer + numbers + struct.pack('<I', count))


def _sequence_number(number: int) -> bytes:
    return struct.pack('<iI', number >> 32, number & 0xFFFFFFFF)


def _submessage(kind: int, flags: int, body: bytes) -> bytes:
    return struct.pack('<BBH', kind, flags | LITTLE_ENDIAN, len(body)) + body
