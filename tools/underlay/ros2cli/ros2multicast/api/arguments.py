# SPDX-License-Identifier: Apache-2.0
"""Arguments for the address and TTL of multicast packets."""

from __future__ import annotations

import argparse

DEFAULT_GROUP = '225.0.0.1'
DEFAULT_PORT = 49150
DEFAULT_TTL = 255


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
        raise argparse.ArgumentTypeError(f'{text!r} is no number from {least} to {most}')
    return int(text)


def _multicast_group(text: str) -> str:
    from ipaddress import AddressValueError, IPv4Address

    try:
        address = IPv4Address(text)
    except AddressValueError as error:
        raise argparse.ArgumentTypeError(f'{text!r} is no IPv4 address: {error}') from error
    if not address.is_multicast:
        raise argparse.ArgumentTypeError(
            f'{text!r} is no multicast address: those go from 224.0.0.0 to 239.255.255.255'
        )
    return text
