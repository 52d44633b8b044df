# SPDX-License-Identifier: Apache-2.0
"""UDP multicast: the arguments for a group, and sending to it and receiving from it."""

from __future__ import annotations

import argparse
import socket
import struct

from ros2cli.waiting import Patience

__all__ = ['DEFAULT_TTL', 'add_group_arguments', 'receive', 'send', 'time_to_live']

MOST_BYTES = 4096
PERIOD_S = 0.2
DEFAULT_GROUP = '225.0.0.1'
DEFAULT_PORT = 49150
DEFAULT_TTL = 255


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


def add_group_arguments(parser: argparse.ArgumentParser) -> None:
    """
    Add the multicast group and the port.

    Parameters
    ----------
    parser
        The parser of a verb.

    """
    parser.add_argument(
        '-g',
        '--group',
        type=_multicast_group,
        default=DEFAULT_GROUP,
        help='The multicast group (default: %(default)s)',
    )
    parser.add_argument(
        '-p',
        '--port',
        type=_port,
        default=DEFAULT_PORT,
        help='The multicast port (default: %(default)s)',
    )


def time_to_live(text: str) -> int:
    """
    Parse the time to live (TTL) of a packet, for argparse.

    Parameters
    ----------
    text
        The argument text.

    Returns
    -------
    int
        The TTL, 0 to 255.

    Raises
    ------
    argparse.ArgumentTypeError
        The text is not such a number.

    """
    return _number(text, 0, 255)


def _port(text: str) -> int:
    return _number(text, 1, 65535)


def _number(text: str, least: int, most: int) -> int:
    if not (text.isascii() and text.isdigit() and least <= int(text) <= most):
        raise argparse.ArgumentTypeError(f'{text!r} is not a number from {least} to {most}')
    return int(text)


def _multicast_group(text: str) -> str:
    from ipaddress import AddressValueError, IPv4Address

    try:
        address = IPv4Address(text)
    except AddressValueError as error:
        raise argparse.ArgumentTypeError(f'{text!r} is not an IPv4 address: {error}') from error
    if not address.is_multicast:
        raise argparse.ArgumentTypeError(
            f'{text!r} is not a multicast address: these range from 224.0.0.0 to 239.255.255.255'
        )
    return text
