# SPDX-License-Identifier: Apache-2.0
"""The discovery servers that ROS_DISCOVERY_SERVER names, and whether a process is told all."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, MutableMapping, Sequence
from contextlib import contextmanager
import os
import re
import socket
from typing import NamedTuple

from ros_environment.suggestions import listing

SERVERS = 'ROS_DISCOVERY_SERVER'
SUPER_CLIENT = 'ROS_SUPER_CLIENT'
DEFAULT_PORT = 11811
MAX_SERVERS = 256
MAX_PORT = 65535
UDP = 'UDPv4'
_ENTRY = re.compile(
    r'(?:(?P<kind>(?:UDP|TCP)v[46]):)?'
    r'(?:\[(?P<bracketed>[^\[\]]+)\]|(?P<host>[^:\[\]\s]+))'
    r'(?::(?P<port>\d{1,5}))?'
)


class Server(NamedTuple):
    """
    A discovery server.

    :param number: its ID, which is its position in the list
    :param host: its name or IP address
    :param kind: the transport, such as UDPv4 or TCPv4
    """

    number: int
    host: str
    port: int
    kind: str = UDP

    @property
    def is_here(self) -> bool:
        """Whether the address is of the loopback interface."""
        return is_loopback(self.host)

    @property
    def start_command(self) -> str:
        """The command that starts it, on its machine."""
        port = '-t 0.0.0.0 -q' if self.kind.startswith('TCP') else '-p'
        return f'fastdds discovery -i {self.number} {port} {self.port}'

    def __str__(self) -> str:
        """Return the address, as the variable has it."""
        return f'{self.host}:{self.port}'


def is_loopback(host: str) -> bool:
    """
    Whether a host is this machine, by the loopback interface.

    Parameters
    ----------
    host
        Its name or IP address.

    """
    return host in ('localhost', '::1') or host.startswith('127.')


def read_servers(environment: Mapping[str, str] = os.environ) -> tuple[Server, ...]:
    """
    Read which discovery servers nodes of this shell use.

    Parameters
    ----------
    environment
        The variables.

    Returns
    -------
    tuple of Server
        The servers; none if nodes discover each other.

    Raises
    ------
    RuntimeError
        An entry of the list is not an address, or there is none; nodes then find nobody.

    """
    value = environment.get(SERVERS, '')
    if value and not value.replace(';', '').strip():
        raise RuntimeError(f"{SERVERS} is '{value}', which names no server: unset {SERVERS}")
    texts = value.split(';')
    return tuple(_server(i, text.strip()) for i, text in enumerate(texts) if text.strip())


def _server(number: int, text: str) -> Server:
    match = _ENTRY.fullmatch(text)
    port = int(match['port'] or DEFAULT_PORT) if match else 0
    if not match or not 0 < port <= MAX_PORT or number >= MAX_SERVERS:
        raise RuntimeError(
            f"{SERVERS} has the entry '{text}', which is not an address: write HOST:PORT, with a "
            f'semicolon between several; for example: export {SERVERS}=192.168.1.2:{DEFAULT_PORT}'
        )
    host = match['bracketed'] or match['host']
    return Server(number, host, port, match['kind'] or (UDP if ':' not in host else 'UDPv6'))


def udp_host(server: Server) -> str:
    """
    Return the IPv4 address of a discovery server.

    Parameters
    ----------
    server
        The server.

    Raises
    ------
    RuntimeError
        Its name cannot be resolved, or it is not reached by UDP over IPv4.

    """
    if server.kind != UDP:
        raise RuntimeError(
            f"{SERVERS} names '{server}' with {server.kind}. Nodes use it, but the commands that "
            'look at the graph reach discovery servers by UDP over IPv4 only: have the server '
            'listen there, too, and name that address'
        )
    try:
        return socket.gethostbyname(server.host)
    except (OSError, UnicodeError) as error:
        raise RuntimeError(
            f"{SERVERS} names '{server.host}', which cannot be resolved ({error}): use its IP "
            f'address, or: unset {SERVERS}'
        ) from error


def no_server(servers: Sequence[Server], *, is_local: bool) -> str:
    """
    Build the warning that no discovery server answers.

    Parameters
    ----------
    servers
        All servers, at least one.
    is_local
        Whether the discovery range keeps to this machine.

    """
    where = listing([str(each) for each in servers])
    mend = f'start one there, for example with "{servers[0].start_command}"'
    if is_local and not all(each.is_here for each in servers):
        mend = 'reach other machines with: export ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET'
    return (
        f'WARNING: no discovery server answers at {where} ({SERVERS}), so no node is found; '
        f'{mend}; or do without it: unset {SERVERS}'
    )


@contextmanager
def as_super_client(environment: MutableMapping[str, str] = os.environ) -> Iterator[None]:
    """
    Have the participants that are created meanwhile told about all nodes by a discovery server.

    Otherwise it tells them only about those with which they share a topic. A choice of the user
    stays as it is, and without a server there is nothing to choose.

    Parameters
    ----------
    environment
        The variables of the process.

    """
    if not environment.get(SERVERS) or SUPER_CLIENT in environment:
        yield
        return
    environment[SUPER_CLIENT] = 'TRUE'
    try:
        yield
    finally:
        environment.pop(SUPER_CLIENT, None)
