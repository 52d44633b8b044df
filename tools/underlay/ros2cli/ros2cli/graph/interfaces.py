# SPDX-License-Identifier: Apache-2.0
"""The network interfaces, as the Linux kernel lists them."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
import fcntl
import socket
import struct

GET_FLAGS = 0x8913
GET_ADDRESS = 0x8915
IS_UP = 0x1
IS_LOOPBACK = 0x8
HAS_MULTICAST = 0x1000
NAME_BYTES = 16
ADDRESS_BYTES = slice(20, 24)


@dataclass(frozen=True)
class Interface:
    """
    A network interface.

    :param address: its IPv4 address, or ''
    :param has_multicast: whether the kernel reports multicast; the loopback works without it
    """

    name: str
    address: str
    is_up: bool
    is_loopback: bool
    has_multicast: bool


def read_interfaces() -> Iterator[Interface]:
    """Yield all interfaces of this machine; those that disappear meanwhile are skipped."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as asked:
        for _, name in socket.if_nameindex():
            with suppress(OSError):
                yield _interface(asked, name)


def _interface(asked: socket.socket, name: str) -> Interface:
    flags = struct.unpack('H', _ask(asked, GET_FLAGS, name)[NAME_BYTES:][:2])[0]
    return Interface(
        name=name,
        address=_address(asked, name),
        is_up=bool(flags & IS_UP),
        is_loopback=bool(flags & IS_LOOPBACK),
        has_multicast=bool(flags & HAS_MULTICAST),
    )


def _address(asked: socket.socket, name: str) -> str:
    try:
        return socket.inet_ntoa(_ask(asked, GET_ADDRESS, name)[ADDRESS_BYTES])
    except OSError:
        return ''


def _ask(asked: socket.socket, request: int, name: str) -> bytes:
    return fcntl.ioctl(asked, request, struct.pack('256s', name.encode()))
