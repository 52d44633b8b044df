# SPDX-License-Identifier: Apache-2.0
"""Send and receive packets by UDP multicast."""

from __future__ import annotations

import socket
import struct

from ros2cli.patience import Patience

__all__ = ['receive', 'send']

MOST_BYTES = 4096
PERIOD_S = 0.2


def send(data: bytes, *, group: str, port: int, ttl: int) -> None:
    """
    Send one UDP packet to a multicast group.

    Parameters
    ----------
    data
        The payload.
    group, port
        The IPv4 address of the group, and the UDP port.
    ttl
        Time to live (0 to 255): 0 stays on this machine, 1 in this network, each router uses one.

    Raises
    ------
    RuntimeError
        The packet cannot be sent; the message states why.

    """
    try:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM, socket.IPPROTO_UDP) as sender:
            sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, ttl)
            sender.sendto(data, (group, port))
    except OSError as error:
        raise RuntimeError(_text('cannot be sent to', group, port, error)) from error


def receive(*, group: str, port: int) -> tuple[bytes, tuple[str, int]]:
    """
    Join a multicast group and wait for one UDP packet, however long that takes.

    Parameters
    ----------
    group, port
        The IPv4 address of the group, and the UDP port.

    Returns
    -------
    tuple
        The payload, of which at most 4096 bytes are kept, and the address and port of the sender.

    Raises
    ------
    RuntimeError
        The group cannot be joined, or the port is taken; the message states why.

    """
    try:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM, socket.IPPROTO_UDP) as receiver:
            _join(receiver, group, port)
            return _wait_for_packet(receiver, f'a packet to {group}:{port}')
    except OSError as error:
        raise RuntimeError(_text('cannot be received on', group, port, error)) from error


def _join(receiver: socket.socket, group: str, port: int) -> None:
    receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    receiver.bind(('', port))
    membership = struct.pack('=4sl', socket.inet_aton(group), socket.INADDR_ANY)
    receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, membership)


def _wait_for_packet(receiver: socket.socket, what: str) -> tuple[bytes, tuple[str, int]]:
    receiver.settimeout(PERIOD_S)
    patience = Patience(what)
    while True:
        try:
            data, address = receiver.recvfrom(MOST_BYTES)
            return data, address
        except TimeoutError:
            patience.check()


def _text(what: str, group: str, port: int, error: OSError) -> str:
    return f'A packet {what} {group}:{port}: {error.strerror or error}'
