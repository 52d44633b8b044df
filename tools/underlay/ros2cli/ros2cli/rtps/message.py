# SPDX-License-Identifier: Apache-2.0
"""Datagrams, built to send and decoded on receipt: a header and submessages (8.3, 9.4)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
import struct
from typing import NamedTuple

from ros2cli.rtps.identifiers import (
    MAX_NUMBERS,
    PID_STATUS_INFO,
    PREFIX_BYTES,
    PROTOCOL_VERSION,
    VENDOR_BYTES,
)
from ros2cli.rtps.parameters import Parameters, read_parameters

MAGIC = b'RTPS'
HEADER_BYTES = 20
PAD, ACKNACK, HEARTBEAT, GAP, INFO_TIME = 0x01, 0x06, 0x07, 0x08, 0x09
INFO_DESTINATION, DATA, DATA_FRAG = 0x0E, 0x15, 0x16
MAY_BE_EMPTY = (PAD, INFO_TIME)  # while the others then reach to the end of the datagram
LITTLE_ENDIAN = 0b0001
INLINE_QOS = 0b0010
PAYLOAD = 0b0100
KEY = 0b1000
KEY_OF_FRAGMENT = 0b0100
MAX_NUMBER = 2**62  # of a sample; the last 64-bit numbers are not worth a special case
FINAL = 0b0010


class Data(NamedTuple):
    """A sample, or the disposal of an instance, which may contain only the key."""

    reader: bytes
    writer: bytes
    number: int
    payload: bytes
    inline: Parameters
    is_disposed: bool


class Fragment(NamedTuple):
    """
    Fragment of a sample that is too large for one datagram.

    :param start: offset of the fragment in the sample
    :param size: size of the whole sample
    """

    reader: bytes
    writer: bytes
    number: int
    start: int
    size: int
    payload: bytes


class Heartbeat(NamedTuple):
    """The range of sequence numbers that a writer has."""

    reader: bytes
    writer: bytes
    first: int
    last: int


class Gap(NamedTuple):
    """Sequence numbers that a writer no longer has: those from start to end - 1, and some more."""

    reader: bytes
    writer: bytes
    start: int
    end: int
    numbers: frozenset[int]


Submessage = Data | Fragment | Heartbeat | Gap


def sender(datagram: bytes) -> bytes | None:
    """
    Return the GUID prefix (12 bytes) of a datagram's sender; None if it is not RTPS.

    Parameters
    ----------
    datagram
        The datagram as it was received.

    """
    if len(datagram) < HEADER_BYTES or not datagram.startswith(MAGIC):
        return None
    return datagram[:HEADER_BYTES][-PREFIX_BYTES:]


def submessages(datagram: bytes, own_prefix: bytes) -> Iterator[Submessage]:
    """
    Decode the submessages of a datagram that are addressed to us and describe the graph.

    Parameters
    ----------
    datagram
        The datagram, which `sender` has recognized as RTPS.
    own_prefix
        Our GUID prefix (12 bytes).

    Yields
    ------
    Submessage
        Samples, fragments, heartbeats and gaps, in their order.

    Raises
    ------
    ValueError
        The datagram is damaged.

    """
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
        offset = start + length if length or kind in MAY_BE_EMPTY else len(datagram)
        if offset > len(datagram):
            raise ValueError(f'{offset - len(datagram)} bytes of a datagram are missing')
        body = datagram[start:offset]
        if kind == INFO_DESTINATION:
            is_for_us = body[:PREFIX_BYTES] in (own_prefix, bytes(PREFIX_BYTES))
        elif is_for_us and kind in _DECODERS:
            yield _DECODERS[kind](body, flags, order)


def _number(body: bytes, offset: int, order: str) -> int:
    high, low = struct.unpack_from(f'{order}iI', body, offset)
    number = (int(high) << 32) + int(low)
    if not 0 <= number <= MAX_NUMBER:
        raise ValueError(f'the sequence number {number}')
    return number


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


def _fragment(body: bytes, flags: int, order: str) -> Fragment:
    (to_qos,) = struct.unpack_from(f'{order}H', body, 2)
    first, _count, unit, size = struct.unpack_from(f'{order}IHHI', body, 20)
    offset = 4 + to_qos
    if flags & INLINE_QOS:
        _, offset = read_parameters(body, offset, order)
    if flags & KEY_OF_FRAGMENT or not 1 <= first <= size:
        raise ValueError(f'fragment {first} of a sample of {size} bytes')
    start = (first - 1) * unit
    return Fragment(body[4:8], body[8:12], _number(body, 12, order), start, size, body[offset:])


def _heartbeat(body: bytes, _: int, order: str) -> Heartbeat:
    first, last = _number(body, 8, order), _number(body, 16, order)
    if not 1 <= first <= last + 1:
        raise ValueError(f'samples from {first} to {last}')
    return Heartbeat(body[:4], body[4:8], first, last)


def _gap(body: bytes, _: int, order: str) -> Gap:
    end, numbers = _number_set(body, 16, order)
    return Gap(body[:4], body[4:8], _number(body, 8, order), end, numbers)


_DECODERS: dict[int, Callable[[bytes, int, str], Submessage]] = {
    DATA: _data,
    DATA_FRAG: _fragment,
    HEARTBEAT: _heartbeat,
    GAP: _gap,
}


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
    return b''.join((MAGIC, PROTOCOL_VERSION, own_prefix[:VENDOR_BYTES], own_prefix, *parts))


def info_destination(prefix: bytes) -> bytes:
    """
    Build an INFO_DST submessage, which names the receiver of the submessages that follow.

    Parameters
    ----------
    prefix
        The GUID prefix (12 bytes) of the receiver.

    """
    return _submessage(INFO_DESTINATION, 0, prefix)


def data(
    reader: bytes,
    writer: bytes,
    number: int,
    payload: bytes,
    inline: bytes = b'',
    *,
    is_key: bool = False,
) -> bytes:
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
    inline
        Inline QoS parameters.
    is_key
        Whether the payload is only the key.

    """
    flags = (KEY if is_key else PAYLOAD) | (INLINE_QOS if inline else 0)
    ends = struct.pack('<HH', 0, 16) + reader + writer
    return _submessage(DATA, flags, ends + sequence_number(number) + inline + payload)


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
    numbers = sequence_number(first) + sequence_number(last)
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
    numbers = sequence_number(base) + struct.pack(f'<I{len(words)}I', size, *words)
    return _submessage(ACKNACK, flags, reader + writer + numbers + struct.pack('<I', count))


def sequence_number(number: int) -> bytes:
    """
    Encode the sequence number of a sample.

    Parameters
    ----------
    number
        The number, from 1 on.

    """
    return struct.pack('<iI', number >> 32, number & 0xFFFFFFFF)


def _submessage(kind: int, flags: int, body: bytes) -> bytes:
    return struct.pack('<BBH', kind, flags | LITTLE_ENDIAN, len(body)) + body
