# SPDX-License-Identifier: Apache-2.0
"""Test multicast; nothing leaves this machine."""

from __future__ import annotations

import os
import socket

DDS_GROUP = '239.255.0.1'
DDS_PORT = 7400
TIMEOUT_S = 0.5
STAYS_HERE = 0
TOKEN_BYTES = 8


def multicast_error(address: str) -> OSError | None:
    """
    Test whether an interface delivers multicast, with a packet to the DDS discovery group.

    The packet does not leave this machine.

    Parameters
    ----------
    address
        The IPv4 address of the interface.

    Returns
    -------
    OSError or None
        None if the packet came back, TimeoutError if not within 0.5 s, else the error.

    """
    try:
        with _receiver(address) as receiver, _sender(address) as sender:
            sender.sendto(os.urandom(TOKEN_BYTES), (DDS_GROUP, receiver.getsockname()[1]))
            receiver.recv(TOKEN_BYTES)
    except OSError as error:
        return error
    return None


def has_multicast_route() -> bool:
    """Whether the kernel has a route to the DDS multicast group; nothing is sent."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as asked:
        try:
            asked.connect((DDS_GROUP, DDS_PORT))
        except OSError:
            return False
    return True


def _receiver(address: str) -> socket.socket:
    receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    try:
        receiver.bind(('', 0))
        receiver.settimeout(TIMEOUT_S)
        membership = socket.inet_aton(DDS_GROUP) + socket.inet_aton(address)
        receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, membership)
    except OSError:
        receiver.close()
        raise
    return receiver


def _sender(address: str) -> socket.socket:
    sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    try:
        interface = socket.inet_aton(address)
        sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, interface)
        sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, STAYS_HERE)
        sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_LOOP, 1)
    except OSError:
        sender.close()
        raise
    return sender
