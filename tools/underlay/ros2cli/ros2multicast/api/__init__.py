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
    """Send one packet to a group; RuntimeError says why the network does not take it."""
    try:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM, socket.IPPROTO_UDP) as sender:
            sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, ttl)
            sender.sendto(data, (group, port))
    except OSError as error:
        raise RuntimeError(_text('cannot be sent to', group, port, error)) from error


def receive(*, group: str, port: int) -> tuple[bytes, tuple[str, int]]:
    """Wait for a packet of a group; return it with the address that it comes from."""
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
