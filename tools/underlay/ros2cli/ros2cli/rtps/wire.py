# SPDX-License-Identifier: Apache-2.0
"""Datagrams: a header and submessages (8.3, 9.4)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
import struct
from typing import NamedTuple

from ros2cli.rtps.identifiers import (
    PID_STATUS_INFO,
    PREFIX_BYTES,
    PROTOCOL_VERSION,
    VENDOR_UNKNOWN,
)
from ros2cli.rtps.parameters import Parameters, read_parameters

MAGIC = b'RTPS'
HEADER_BYTES = 20
ACKNACK, HEARTBEAT, GAP, INFO_DESTINATION, DATA = 0x06, 0x07, 0x08, 0x0E, 0x15
LITTLE_ENDIAN = 0b0001
FINAL = 0b0010
INLINE_QOS = 0b0010
PAYLOAD = 0b0100
KEY = 0b1000
MAX_NUMBERS = 256  # in a set of sequence numbers


class Data(NamedTuple):
    """A sample, or the news that an instance is no more, of which only the key may be there."""

    reader: bytes
    writer: bytes
    number: int
    payload: bytes
    inline: Parameters
    is_disposed: bool


class Heartbeat(NamedTuple):
    """The sequence numbers that a writer has."""

    reader: bytes
    writer: bytes
    first: int
    last: int


class Gap(NamedTuple):
    """Sequence numbers that a writer no longer has."""

    reader: bytes
    writer: bytes
    numbers: frozenset[int]


Submessage = Data | Heartbeat | Gap


def sender(datagram: bytes) -> bytes | None:
    """Return the GUID prefix of who sent a datagram; None if it is not one of RTPS."""
    if len(datagram) < HEADER_BYTES or not datagram.startswith(MAGIC):
        return None
    return datagram[:HEADER_BYTES][-PREFIX_BYTES:]


def submessages(datagram: bytes, own_prefix: bytes) -> Iterator[Submessage]:
    """Yield what a datagram tells us; ValueError if it is damaged."""
    try:
        yield from _submessages(datagram, own_prefix)
    except (struct.error, IndexError) as error:
        raise ValueError(f'damaged datagram: {error}') from error


def _submessages(datagram: bytes, own_prefix: bytes) -> Iterator[Submessage]:
    offset = HEADER_BYTES
    is_for_us = True
    while offset + 4 <= len(datagram):
        kind, flags = datagram[offset], datagram[offset + 1]
        order = '<' if flags & LITTLE_ENDIAN else '>'
        (length,) = struct.unpack_from(f'{order}H', datagram, offset + 2)
        start = offset + 4
        offset = start + length if length else len(datagram)
        if offset > len(datagram):
            raise ValueError(f'{offset - len(datagram)} bytes of a datagram are missing')
        body = datagram[start:offset]
        if kind == INFO_DESTINATION:
            is_for_us = body[:PREFIX_BYTES] in (own_prefix, bytes(PREFIX_BYTES))
        elif is_for_us and kind in _DECODERS:
            yield _DECODERS[kind](body, flags, order)


def _number(body: bytes, offset: int, order: str) -> int:
    high, low = struct.unpack_from(f'{order}iI', body, offset)
    return (int(high) << 32) + int(low)


def _number_set(body: bytes, offset: int, order: str) -> tuple[int, frozenset[int]]:
    base = _number(body, offset, order)
    (size,) = struct.unpack_from(f'{order}I', body, offset + 8)
    if size > MAX_NUMBERS:
        raise ValueError(f'a set of {size} sequence numbers')
    words = struct.unpack_from(f'{order}{(size + 31) // 32}I', body, offset + 12)
    return base, frozenset(base + i for i in range(size) if words[i // 32] & (1 << (31 - i % 32)))


def _data(body: bytes, flags: int, order: str) -> Data:
    (to_qos,) = struct.unpack_from(f'{order}H', body, 2)
    offset = 4 + to_qos
    inline = Parameters({}, order)
    if flags & INLINE_QOS:
        inline, offset = read_parameters(body, offset, order)
    payload = body[offset:] if flags & (PAYLOAD | KEY) else b''
    is_disposed = bool(flags & KEY) or any(inline.first(PID_STATUS_INFO)[3:4])
    return Data(body[4:8], body[8:12], _number(body, 12, order), payload, inline, is_disposed)


def _heartbeat(body: bytes, _: int, order: str) -> Heartbeat:
    return Heartbeat(body[:4], body[4:8], _number(body, 8, order), _number(body, 16, order))


def _gap(body: bytes, _: int, order: str) -> Gap:
    start = _number(body, 8, order)
    base, numbers = _number_set(body, 16, order)
    if base - start > MAX_NUMBERS * MAX_NUMBERS:
        raise ValueError(f'a gap of {base - start} sequence numbers')
    return Gap(body[:4], body[4:8], numbers | frozenset(range(start, base)))


_DECODERS: dict[int, Callable[[bytes, int, str], Submessage]] = {
    DATA: _data,
    HEARTBEAT: _heartbeat,
    GAP: _gap,
}


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
