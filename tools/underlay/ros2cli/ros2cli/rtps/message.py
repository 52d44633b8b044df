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
    """Return a datagram of submessages."""
    return b''.join((MAGIC, PROTOCOL_VERSION, VENDOR_UNKNOWN, own_prefix, *parts))


def info_destination(prefix: bytes) -> bytes:
    """Say for whom the submessages that follow are."""
    return _submessage(INFO_DESTINATION, 0, prefix)


def data(reader: bytes, writer: bytes, number: int, payload: bytes, key_qos: bytes = b'') -> bytes:
    """Return a sample; with `key_qos`, inline parameters, the payload is only the key."""
    flags = INLINE_QOS | KEY if key_qos else PAYLOAD
    ends = struct.pack('<HH', 0, 16) + reader + writer
    return _submessage(DATA, flags, ends + _sequence_number(number) + key_qos + payload)


def heartbeat(reader: bytes, writer: bytes, first: int, last: int, count: int) -> bytes:
    """Tell a reader which sequence numbers there are, and ask what it lacks."""
    numbers = _sequence_number(first) + _sequence_number(last)
    return _submessage(HEARTBEAT, 0, reader + writer + numbers + struct.pack('<I', count))


def acknack(reader: bytes, writer: bytes, base: int, missing: list[int], count: int) -> bytes:
    """Tell a writer that all before `base` has come; ask for what is missing, if anything is."""
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
