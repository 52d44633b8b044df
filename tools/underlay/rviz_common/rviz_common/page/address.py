# SPDX-License-Identifier: Apache-2.0
"""Where a page is served: its host and port, and the addresses at which browsers reach it."""

from __future__ import annotations

from dataclasses import dataclass
import errno
import ipaddress
import os
import socket
from typing import Any, TYPE_CHECKING

from ros2cli.graph.reach import read_interfaces

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = [
    'NO_TOKEN',
    'PARAMETERS',
    'PageSettings',
    'PortError',
    'declare_settings',
    'listen',
    'reachable',
]

FIRST_PORT = 8080
NO_TOKEN = 'none'
"""The value of the token that disables it: all users of this machine are admitted."""
PARAMETERS: dict[str, tuple[str | int, str]] = {
    'host': ('127.0.0.1', 'The address at which the page is served.'),
    'port': (0, 'The port of the page; 0: the first free one from 8080 on.'),
    'token': ('', 'The token that opens the page; random if empty, "none" for no token.'),
}
"""The ROS parameters of a node with a page: names, defaults and descriptions."""

TRIES = 100


@dataclass(frozen=True)
class PageSettings:
    """
    Where a page is served, and to whom.

    Without a port, the first free one from 8080 on is used. A token is required to open the page,
    as any user or program on this machine could open it otherwise; one is generated if none is
    given. `NO_TOKEN` disables the token, on a loopback address only.
    """

    host: str = '127.0.0.1'
    port: int | None = None
    token: str = ''

    def __post_init__(self) -> None:
        """Validate the host and the port."""
        try:
            ipaddress.ip_address(self.host)
        except ValueError:
            raise ValueError(
                f"The host is '{self.host}', but must be an address of this machine, such as "
                '127.0.0.1, or 0.0.0.0 for all of them.'
            ) from None
        if self.port is not None and not 1 <= self.port <= 65535:
            raise ValueError(f'The port is {self.port}, but must be from 1 to 65535.')
        if self.token == NO_TOKEN and not self.is_local:
            raise ValueError(
                f"The token is 'none', but other machines reach {self.host}: anyone there "
                'could drive the robot. Choose a token, as in token:=TEXT, or host:=127.0.0.1.'
            )

    @property
    def is_local(self) -> bool:
        """Whether only this machine can reach the page."""
        return ipaddress.ip_address(self.host).is_loopback


def declare_settings(node: Node) -> PageSettings:
    """
    Declare the parameters `host`, `port` and `token`, and read the settings of the page from them.

    Parameters
    ----------
    node
        The node that declares them, read-only. A `port` of 0 stands for the first free one.

    Raises
    ------
    ValueError
        The host is not an IP address, the port is outside 1 to 65535, or the token is `none` on an
        address that other machines reach.
    rclpy.exceptions.ParameterException
        A parameter has been overridden with a value of another type.

    """
    from rcl_interfaces.msg import ParameterDescriptor

    def declare(name: str) -> Any:
        default, text = PARAMETERS[name]
        descriptor = ParameterDescriptor(description=text, read_only=True)
        return node.declare_parameter(name, default, descriptor).value

    values = {name: declare(name) for name in PARAMETERS}
    return PageSettings(values['host'], values['port'] or None, values['token'])


class PortError(RuntimeError):
    """A port that cannot be used, with the reason."""


def listen(settings: PageSettings) -> socket.socket:
    """
    Open a listening socket at the port of the settings or, without one, at a free one.

    The socket is already listening: several programs can bind a port until one of them listens.

    Parameters
    ----------
    settings
        The host, and the port or None for the first free one from 8080 on.

    Raises
    ------
    PortError
        The host or the port cannot be used, or 100 ports are in use; the message says why.

    """
    if settings.port is not None:
        return _listen(settings.host, settings.port)
    for port in range(FIRST_PORT, FIRST_PORT + TRIES):
        try:
            return _listen(settings.host, port)
        except PortError as error:
            failure = error
    raise failure


def _listen(host: str, port: int) -> socket.socket:
    family = socket.AF_INET6 if ':' in host else socket.AF_INET
    bound = socket.socket(family, socket.SOCK_STREAM)
    bound.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        bound.bind((host, port))
        bound.listen()
    except OSError as error:
        bound.close()
        raise PortError(_reason(host, port, error.errno or 0)) from error
    return bound


def _reason(host: str, port: int, number: int) -> str:
    """Describe why a port cannot be used, and what to do about it."""
    why = os.strerror(number)
    if number not in (errno.EADDRINUSE, errno.EACCES):
        return (
            f'{host} cannot be used: {why}. The host must be an address of this machine, such as '
            '127.0.0.1, or 0.0.0.0 for all of them.'
        )
    return (
        f'Port {port} of {host} cannot be taken: {why}. Stop the program that uses it, or choose '
        'another port; without a choice, the next free one is used.'
    )


def reachable(host: str) -> list[str]:
    """
    List the addresses at which a page served at a host is reachable.

    Parameters
    ----------
    host
        An IP address. The unspecified one, such as 0.0.0.0, stands for all interfaces.

    Returns
    -------
    list[str]
        Addresses; first the one with the default route, if there is one. The loopback address
        is listed only if there is no other.

    """
    address = ipaddress.ip_address(host)
    if not address.is_unspecified:
        return [host]
    first = _address_to_other_networks(address.version)
    others = [each.address for each in read_interfaces() if each.is_up and not each.is_loopback]
    found = [each for each in (first, *others) if each]
    return list(dict.fromkeys(found)) or ['127.0.0.1' if address.version == 4 else '::1']


def _address_to_other_networks(version: int) -> str:
    """Return the source address of the default route; '' without a default route."""
    family, test_net = (
        (socket.AF_INET, '192.0.2.1') if version == 4 else (socket.AF_INET6, '2001:db8::1')
    )
    with socket.socket(family, socket.SOCK_DGRAM) as asking:
        try:
            asking.connect((test_net, 9))  # sends nothing, but selects the source address
        except OSError:
            return ''
        return str(asking.getsockname()[0])
