# SPDX-License-Identifier: Apache-2.0
"""How far discovery reaches from this shell: domain, discovery range and network interfaces."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
import fcntl
import os
import socket
import struct
from typing import NamedTuple

from ros2cli.graph.servers import read_servers, Server

LOCALHOST, SUBNET, SYSTEM_DEFAULT, OFF = 'LOCALHOST', 'SUBNET', 'SYSTEM_DEFAULT', 'OFF'
MAX_DOMAIN_ID = 232
# ioctl requests and flags of Linux, from netdevice(7).
GET_FLAGS = 0x8913
GET_ADDRESS = 0x8915
IS_UP = 0x1
IS_LOOPBACK = 0x8
HAS_MULTICAST = 0x1000
NAME_BYTES = 16
ADDRESS_BYTES = slice(20, 24)


class Reach(NamedTuple):
    """
    The domain, the discovery range, the static peers and the discovery servers.

    With LOCALHOST no socket is open to other machines (see the profile of ros_environment), so
    that other hosts are not asked, either.

    :param extent: a value of ROS_AUTOMATIC_DISCOVERY_RANGE
    :param servers: the discovery servers, which take the place of multicast and static peers
    """

    domain_id: int
    extent: str
    peers: tuple[str, ...] = ()
    servers: tuple[Server, ...] = ()

    @property
    def is_local(self) -> bool:
        """Whether no other machine is reached, so that all participants can be counted."""
        return self.extent in (OFF, LOCALHOST)

    @property
    def is_wide(self) -> bool:
        """Whether participants are discovered by multicast, and not only at static peers."""
        return self.extent in (SUBNET, SYSTEM_DEFAULT)


def read_reach(environment: Mapping[str, str] = os.environ) -> Reach:
    """
    Read the domain and the discovery range from environment variables.

    Parameters
    ----------
    environment
        The variables.

    Raises
    ------
    RuntimeError
        The domain ID or an address of a discovery server is not valid.

    """
    extent = _extent(environment)
    peers = () if extent in (OFF, LOCALHOST) else _peers(environment)
    return Reach(_domain_id(environment), extent, peers, read_servers(environment))


def _domain_id(environment: Mapping[str, str]) -> int:
    text = environment.get('ROS_DOMAIN_ID') or '0'
    if not text.isdecimal() or int(text) > MAX_DOMAIN_ID:
        raise RuntimeError(
            f"ROS_DOMAIN_ID is '{text}', which is not a number from 0 to {MAX_DOMAIN_ID}; "
            'correct it, or remove it with: unset ROS_DOMAIN_ID'
        )
    return int(text)


def _extent(environment: Mapping[str, str]) -> str:
    """Return the discovery range by the rules of rcl; unknown values mean LOCALHOST."""
    if _is_localhost_only(environment):
        return LOCALHOST
    extent = environment.get('ROS_AUTOMATIC_DISCOVERY_RANGE') or SUBNET
    return extent if extent in (SUBNET, SYSTEM_DEFAULT, OFF) else LOCALHOST


def _peers(environment: Mapping[str, str]) -> tuple[str, ...]:
    texts = environment.get('ROS_STATIC_PEERS', '').split(';')
    return tuple(text.strip() for text in texts if text.strip())


def _is_localhost_only(environment: Mapping[str, str]) -> bool:
    return environment.get('ROS_LOCALHOST_ONLY') == '1'


class Interface(NamedTuple):
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
