# SPDX-License-Identifier: Apache-2.0
"""Parameter lists, by which participants and endpoints describe themselves (9.4.2.11)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
import itertools
import socket
import struct
from typing import NamedTuple

PID_SENTINEL = 0x01
PL_CDR_LE = b'\x00\x03\x00\x00'
UDP_V4 = 1
MAX_PORT = 65535
LOCATOR_BYTES = 24
NO_PARAMETER = b''
INFINITE = (0x7FFFFFFF, 0xFFFFFFFF)
INFINITE_NS = 2**63 - 1
Address = tuple[str, int]
THIS_HOST = '127.0.0.1'


class Parameters(NamedTuple):
    """The values of a parameter list by their identifiers, and their byte order."""

    values: dict[int, list[bytes]]
    order: str

    def first(self, identifier: int) -> bytes:
        """
        Return the first value of a parameter; empty if it is missing.

        Parameters
        ----------
        identifier
            The parameter ID.

        """
        return self.values.get(identifier, [NO_PARAMETER])[0]

    def text(self, identifier: int) -> str:
        """
        Decode a string parameter; '' if it is missing.

        Parameters
        ----------
        identifier
            The parameter ID.

        Raises
        ------
        ValueError
            The value is damaged.

        """
        return text_of(self.octets(identifier))

    def octets(self, identifier: int) -> bytes:
        """
        Decode a parameter that is a sequence of bytes; empty if it is missing.

        Parameters
        ----------
        identifier
            The parameter ID.

        Raises
        ------
        ValueError
            The value is damaged.

        """
        raw = self.first(identifier)
        if not raw:
            return b''
        (size,) = self._unpack('I', raw)
        return raw[4:][:size]

    def number(self, identifier: int, default: int) -> int:
        """
        Decode a parameter that is an enumerator.

        Parameters
        ----------
        identifier
            The parameter ID.
        default
            What is returned if it is missing.

        Raises
        ------
        ValueError
            The value is damaged.

        """
        raw = self.first(identifier)
        if not raw:
            return default
        (number,) = self._unpack('I', raw)
        return number

    def duration_ns(self, identifier: int, offset: int = 0) -> int:
        """
        Decode a parameter that is a duration.

        Parameters
        ----------
        identifier
            The parameter ID.
        offset
            The offset of the duration in the value, in bytes.

        Returns
        -------
        int
            Nanoseconds; INFINITE_NS if it is infinite or missing.

        Raises
        ------
        ValueError
            The value is damaged.

        """
        raw = self.first(identifier)
        if not raw:
            return INFINITE_NS
        seconds, fraction = self._unpack('iI', raw[offset:])
        if (seconds, fraction) == INFINITE:
            return INFINITE_NS
        return seconds * 10**9 + round(fraction * 10**9 / 2**32)

    def addresses(self, identifier: int) -> list[Address]:
        """
        Decode UDPv4 locators; those of other transports are left out.

        Parameters
        ----------
        identifier
            The parameter ID.

        Raises
        ------
        ValueError
            A value is damaged.

        """
        values = [raw for raw in self.values.get(identifier, []) if len(raw) >= LOCATOR_BYTES]
        hosts = [socket.inet_ntoa(raw[LOCATOR_BYTES - 4 : LOCATOR_BYTES]) for raw in values]
        found = [self._unpack('iI', raw) for raw in values]
        return [
            (host, port)
            for host, (kind, port) in zip(hosts, found, strict=True)
            if kind == UDP_V4 and 0 < port <= MAX_PORT
        ]

    def _unpack(self, layout: str, raw: bytes) -> tuple[int, ...]:
        try:
            return struct.unpack_from(f'{self.order}{layout}', raw)
        except struct.error as error:
            raise ValueError(f'a damaged parameter: {error}') from error


def decode_parameters(payload: bytes) -> Parameters:
    """
    Decode a list of parameters with its encapsulation header.

    Parameters
    ----------
    payload
        The serialized list.

    Raises
    ------
    ValueError
        The list is damaged.

    """
    order = '<' if payload[1:2] in (b'\x01', b'\x03') else '>'
    try:
        return read_parameters(payload, 4, order)[0]
    except struct.error as error:
        raise ValueError(f'damaged list of parameters: {error}') from error


def read_parameters(data: bytes, offset: int, order: str) -> tuple[Parameters, int]:
    """
    Decode a list of parameters in the middle of other data.

    Parameters
    ----------
    data
        The bytes that contain the list.
    offset
        The offset of the list.
    order
        The byte order in the notation of struct, `<` or `>`.

    Returns
    -------
    tuple of Parameters and int
        The list, and the offset at which it ends.

    Raises
    ------
    struct.error
        The list is truncated.

    """
    values: dict[int, list[bytes]] = {}
    while True:
        kind, length = struct.unpack_from(f'{order}HH', data, offset)
        start = offset + 4
        offset = start + length
        if kind == PID_SENTINEL:
            return Parameters(values, order), start
        values.setdefault(kind, []).append(data[start:offset])


def encode_parameters(parameters: Iterable[tuple[int, bytes]]) -> bytes:
    """
    Encode a list of parameters with its encapsulation header.

    Parameters
    ----------
    parameters : Iterable[tuple[int, bytes]]
        Pairs of parameter ID and value.

    """
    return PL_CDR_LE + encode_inline(parameters)


def encode_inline(parameters: Iterable[tuple[int, bytes]]) -> bytes:
    """
    Encode a list of parameters as it stands in front of a payload.

    Parameters
    ----------
    parameters : Iterable[tuple[int, bytes]]
        Pairs of parameter ID and value.

    """
    return b''.join(_parameter(*each) for each in (*parameters, (PID_SENTINEL, b'')))


def _parameter(identifier: int, value: bytes) -> bytes:
    value += bytes(-len(value) % 4)
    return struct.pack('<HH', identifier, len(value)) + value


def text_value(text: str) -> bytes:
    """
    Encode a string as the value of a parameter.

    Parameters
    ----------
    text
        The string.

    """
    raw = text.encode() + b'\0'
    return struct.pack('<I', len(raw)) + raw


def number_value(number: int) -> bytes:
    """
    Encode an enumerator or a set of bits as the value of a parameter.

    Parameters
    ----------
    number
        An unsigned 32-bit number.

    """
    return struct.pack('<I', number)


def duration_value(seconds: int) -> bytes:
    """
    Encode a duration as the value of a parameter.

    Parameters
    ----------
    seconds
        Whole seconds.

    """
    return struct.pack('<iI', seconds, 0)


def locator_value(address: Address) -> bytes:
    """
    Encode a UDPv4 locator as the value of a parameter.

    Parameters
    ----------
    address
        The IPv4 address and the port.

    """
    host, port = address
    return struct.pack('<iI', UDP_V4, port) + bytes(12) + socket.inet_aton(host)


def properties_value(properties: Mapping[str, str]) -> bytes:
    """
    Encode a list of properties as the value of a parameter.

    Parameters
    ----------
    properties
        The values by name.

    """
    value = number_value(len(properties))
    for text in itertools.chain.from_iterable(properties.items()):
        value += text_value(text)
        value += bytes(-len(value) % 4)
    return value


def text_of(raw: bytes) -> str:
    """
    Decode a string from the network; control characters are escaped, to protect the terminal.

    Parameters
    ----------
    raw
        UTF-8, with or without trailing zeros.

    """
    text = raw.rstrip(b'\0').decode('utf-8', 'backslashreplace')
    if text.isprintable():
        return text
    return ''.join(each if each.isprintable() else ascii(each)[1:-1] for each in text)
