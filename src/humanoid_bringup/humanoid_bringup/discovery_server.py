# SPDX-License-Identifier: Apache-2.0
"""Start a discovery server of Fast DDS, and say how nodes on all machines come to use it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
import errno
import fcntl
from ipaddress import AddressValueError, IPv4Address
import os
import socket
import struct
from typing import NamedTuple, Optional

from humanoid_bringup.launch_arguments import whole_number
from humanoid_common.naming import shortened
from launch import Action, LaunchContext
from launch.actions import ExecuteProcess, LogInfo, RegisterEventHandler, Shutdown
from launch.event_handlers import OnProcessIO
from launch.events.process import ProcessIO
from launch.substitutions import LaunchConfiguration

__all__ = ['DEFAULT_PORT', 'ServerSettings', 'discovery_server', 'instructions']

DEFAULT_PORT = 11811
LARGEST_ID = 255
PORTS = range(1025, 65536)
LOOPBACK = '127.0.0.1'
_STARTED = 'Server is running'
_ELSEWHERE = ('192.0.2.1', 9)  # reserved for documentation; nothing is sent there
_SIOCGIFADDR = 0x8915
_ADDRESS = slice(20, 24)  # in the answer: sin_addr of ifr_addr


class ServerSettings(NamedTuple):
    """
    How a discovery server is started.

    :param address: the IPv4 address that it listens at; '' is each of this machine
    :param server_id: its position in ROS_DISCOVERY_SERVER
    """

    address: str
    port: int
    server_id: int

    @classmethod
    def parse(cls, address: str, port: str, server_id: str) -> ServerSettings:
        """
        Read the settings from the texts of launch arguments.

        Parameters
        ----------
        address, port, server_id
            The texts.

        Raises
        ------
        ValueError
            A text is not within its range.

        """
        return cls(
            _own_address(address),
            whole_number('port', port, PORTS, DEFAULT_PORT),
            whole_number('server_id', server_id, range(LARGEST_ID + 1), 1),
        )


def _own_address(text: str) -> str:
    """Check the text of an address of this machine; '' is each of them."""
    try:
        address = IPv4Address(text) if text else None
        is_possible = address is None or not (address.is_multicast or address.is_reserved)
    except AddressValueError:
        is_possible = False
    if not is_possible:
        raise ValueError(
            f"Launch argument 'address' is '{shortened(text)}', but must be an IPv4 address of "
            "this machine, such as 'address:=192.168.1.2'."
        )
    return '' if address is None or address.is_unspecified else text


def discovery_server(context: LaunchContext) -> Sequence[Action]:
    """
    Build the actions that start the server, and say so once it runs.

    Parameters
    ----------
    context
        The launch context, with the arguments `address`, `port` and `server_id`.

    Raises
    ------
    ValueError
        An argument is not within its range, or the server could not listen there.

    """
    names = ('address', 'port', 'server_id')
    settings = ServerSettings.parse(
        *(LaunchConfiguration(each).perform(context) for each in names)
    )
    check_port(settings.address, settings.port)
    where = ['-l', settings.address] if settings.address else []
    server = ExecuteProcess(
        cmd=[
            *('fast-discovery-server', '-i', str(settings.server_id)),
            *('-p', str(settings.port), *where),
        ],
        name='discovery_server',
        output={'stdout': 'log', 'stderr': 'screen'},
        on_exit=Shutdown(reason='the discovery server has ended'),
    )
    hears = OnProcessIO(target_action=server, on_stdout=_announcer(settings))
    return [RegisterEventHandler(hears), server]


def check_port(address: str, port: int) -> None:
    """
    Check that a server can listen at an address, as it does not say so itself.

    Parameters
    ----------
    address, port
        The IPv4 address of this machine, or '' for each, and the UDP port.

    Raises
    ------
    ValueError
        The address belongs to another machine, or the port is taken.

    """
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as tried:
        try:
            tried.bind((address, port))
        except OSError as error:
            if error.errno == errno.EADDRINUSE:
                why = (
                    f'UDP port {port} is taken, perhaps by another discovery server. Stop that '
                    f"one, or pass another port, such as 'port:={port + 1}'"
                )
            elif error.errno == errno.EADDRNOTAVAIL:
                why = (
                    f'{address} is not an address of this machine. Pass one of those that '
                    "'ip address' shows, or leave out the argument 'address'"
                )
            else:
                why = f'{address}:{port} cannot be used: {error.strerror}'
            raise ValueError(f'The discovery server cannot start: {why}.') from None


def _announcer(settings: ServerSettings) -> Callable[[ProcessIO], Optional[Action]]:
    """Return the function that says what to type, once the server prints that it runs."""
    printed: list[str] = []

    def hear(event: ProcessIO) -> Optional[Action]:
        before = ''.join(printed)
        printed.append(event.text.decode(errors='replace'))
        if _STARTED in before or _STARTED not in ''.join(printed):
            return None
        return LogInfo(msg=instructions(settings, own_addresses()))

    return hear


def own_addresses() -> list[str]:
    """List the IPv4 addresses at which other machines may reach this one, the likeliest first."""
    found = [_address_of_route(), *(_address_of(name) for _, name in socket.if_nameindex())]
    reached = (each for each in found if each and not IPv4Address(each).is_loopback)
    return list(dict.fromkeys(reached))


def _address_of_route() -> str:
    """Return the address of this machine on the way to others; '' without a default route."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as asked:
        try:
            asked.connect(_ELSEWHERE)
        except OSError:
            return ''
        return str(asked.getsockname()[0])


def _address_of(interface: str) -> str:
    """Return the IPv4 address of a network interface; '' if it has none."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as asked:
        request = struct.pack('256s', os.fsencode(interface))
        try:
            answer = fcntl.ioctl(asked.fileno(), _SIOCGIFADDR, request)
        except OSError:
            return ''
        return socket.inet_ntoa(answer[_ADDRESS])


def instructions(settings: ServerSettings, own: Sequence[str]) -> str:
    """
    Format what to type in the terminals that use the server.

    Parameters
    ----------
    settings
        The settings of the server.
    own
        The addresses of this machine for others, which are shown if the server listens at each
        address; none without a network.

    """
    hosts = [settings.address] if settings.address else [*own, LOOPBACK][: max(1, len(own))]
    is_shared = not IPv4Address(hosts[0]).is_loopback
    listed = f'{";" * settings.server_id}{hosts[0]}:{settings.port}'
    quoted = f"'{listed}'" if settings.server_id else listed
    where = 'on this machine and on the others' if is_shared else 'on this machine only'
    others = ' or '.join(hosts[1:])
    return '\n'.join(
        [
            f'The discovery server runs at {hosts[0]}:{settings.port}. To use it, type this in '
            f'each terminal, {where}, before you start nodes there:',
            *['    export ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET'] * is_shared,
            f'    export ROS_DISCOVERY_SERVER={quoted}',
            *[f'Machines in another network of this one use {others} instead.'] * bool(others),
        ]
    )
