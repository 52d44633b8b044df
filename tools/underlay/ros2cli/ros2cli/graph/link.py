# SPDX-License-Identifier: Apache-2.0
"""UDP transport of the discovery observer, or of the super client of discovery servers."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections import deque
from collections.abc import Iterator
from contextlib import suppress
import select
import socket
import time

from ros2cli.graph.census import Census, foreign_ports
from ros2cli.graph.reach import OFF, Reach, read_interfaces
from ros2cli.graph.servers import no_server, udp_host
from ros2cli.rtps.identifiers import MULTICAST_ADDRESS, multicast_port, unicast_ports
from ros2cli.rtps.observer import Observer
from ros2cli.rtps.parameters import Address, THIS_HOST
from ros2cli.rtps.super_client import SuperClient

COUNT_PERIOD_S = 0.1
GREETINGS_S = (0.0, 0.1, 0.25)  # of uncounted participants, since a greeting may be lost
PEERS_PER_HOST = 32
MAX_DATAGRAM_BYTES = 65536
RECEIVE_BUFFER_BYTES = 1 << 20
HANDLED_AT_ONCE = 1000
READ_AT_ONCE = 64  # between two that are handled, so that a flood does not block us
MAX_WAITING = 4096
INCOMPLETE = (
    'WARNING: a ROS process on this machine does not answer (is it stopped, or just starting?); '
    'what follows may be incomplete'
)
NODES_MISSING = (
    'WARNING: a ROS process that a discovery server knows does not answer (has it been killed, or '
    'is its machine out of reach?); what follows may be incomplete'
)


def open_link(reach: Reach) -> Link:
    """
    Open the link to the participants: through discovery servers if there are any.

    Parameters
    ----------
    reach
        The domain, the discovery range and the discovery servers.

    Raises
    ------
    RuntimeError
        The address of a static peer or a discovery server cannot be found.

    """
    has_servers = reach.servers and reach.extent != OFF
    return ServerLink(reach) if has_servers else NeighbourLink(reach)


class Link(ABC):
    """
    UDP socket that carries the datagrams of an observer; nothing is sent before `exchange`.

    Parameters
    ----------
    reach
        The domain, the discovery range and the discovery servers.

    Attributes
    ----------
    observer
        Collects the received descriptions.
    can_count
        Whether it is known how many participants this machine has.
    awaited
        Whose answers are awaited, for the user.

    """

    observer: Observer | SuperClient
    can_count = False
    awaited = 'the answers of all ROS processes on this machine'

    def __init__(self, reach: Reach) -> None:
        self._reach = reach
        self._hosts = _own_hosts(reach)
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, RECEIVE_BUFFER_BYTES)
        self._socket.bind((THIS_HOST if reach.is_local else '', 0))
        self._socket.setblocking(False)
        port = self._socket.getsockname()[1]
        self._addresses = [(host, port) for host in self._hosts]
        self._waiting: deque[tuple[bytes, str]] = deque()
        self._start_s = self._count_s = time.monotonic()

    @property
    def is_hopeless(self) -> bool:
        """Whether it is known that those that have not answered will not do so."""
        return False

    @property
    @abstractmethod
    def why_incomplete(self) -> str:
        """The warning if those that are missing do not answer."""

    def close(self) -> None:
        """Send farewells to the participants and close the socket."""
        self.observer.leave()
        self._socket.close()

    def exchange(self, *, waits: bool) -> None:
        """
        Send the requests that are due, and handle the received datagrams.

        Parameters
        ----------
        waits
            Whether to block until a datagram arrives or the next request is due.

        """
        if self._reach.extent == OFF:
            return
        now_s = time.monotonic()
        if now_s >= self._count_s:
            self._count_s = now_s + COUNT_PERIOD_S
            self._count(now_s)
        self._greet(now_s)
        self.observer.ask(now_s)
        if not self._waiting:
            wait_s = min(self.observer.due_s, self._count_s) - now_s if waits else 0.0
            select.select([self._socket], [], [], max(0.0, wait_s))
        self._receive()

    @abstractmethod
    def _count(self, now_s: float) -> None:
        """Look who is on this machine."""

    @abstractmethod
    def _greet(self, now_s: float) -> None:
        """Greet those whom the observer cannot greet by their addresses."""

    def _receive(self) -> None:
        """Handle received datagrams, and drain the small socket buffer in between."""
        self._waiting.extend(self._received())
        for _ in range(HANDLED_AT_ONCE):
            if not self._waiting:
                break
            datagram, host = self._waiting.popleft()
            self.observer.handle(datagram, THIS_HOST if host in self._hosts else host)
            self._waiting.extend(self._received())

    def _received(self) -> Iterator[tuple[bytes, str]]:
        with suppress(BlockingIOError):
            for _ in range(min(READ_AT_ONCE, MAX_WAITING - len(self._waiting))):
                datagram, (host, _port) = self._socket.recvfrom(MAX_DATAGRAM_BYTES)
                yield datagram, host

    def _send(self, datagram: bytes, address: Address) -> None:
        """Send a datagram; ignore errors, since requests are repeated."""
        with suppress(OSError):
            self._socket.sendto(datagram, address)


class ServerLink(Link):
    """
    Link to discovery servers, which know the participants.

    Parameters
    ----------
    reach
        The domain, the discovery range and the discovery servers.

    Raises
    ------
    RuntimeError
        The name of a server cannot be resolved, or it is not reached by UDP over IPv4.

    """

    awaited = 'the answers of the discovery server and the ROS processes that it knows'

    def __init__(self, reach: Reach) -> None:
        servers = {each.number: (udp_host(each), each.port) for each in reach.servers}
        super().__init__(reach)
        # A node with LOCALHOST may announce all addresses, although it listens at one only.
        self._hosts = [THIS_HOST, *_network_addresses()]
        self.observer: SuperClient = SuperClient(self._addresses, self._hosts, servers, self._send)

    @property
    def why_incomplete(self) -> str:
        """The warning if the servers, or nodes that they know, do not answer."""
        if self.observer.answered:
            return NODES_MISSING
        return no_server(self._reach.servers, is_local=self._reach.is_local)

    def _count(self, now_s: float) -> None:
        ports = foreign_ports()
        if ports is not None:
            self.observer.keep(ports)

    def _greet(self, now_s: float) -> None:
        """Greet nobody, as the observer greets the servers."""


class NeighbourLink(Link):
    """
    Link to participants that discover each other.

    Parameters
    ----------
    reach
        The domain, the discovery range and the static peers.

    Raises
    ------
    RuntimeError
        The address of a static peer cannot be found.

    """

    why_incomplete = INCOMPLETE

    def __init__(self, reach: Reach) -> None:
        self._peers = [_address(peer) for peer in reach.peers]
        super().__init__(reach)
        self.observer: Observer = Observer(self._addresses, self._send)
        self.can_count = True
        self._census = Census(reach.domain_id)
        self._greetings = list(GREETINGS_S)

    @property
    def is_hopeless(self) -> bool:
        """Whether stopped processes are the only participants that have not answered."""
        silent = self.observer.silent
        return len(silent) == self.observer.missing and self._census.are_stopped(silent)

    def _count(self, now_s: float) -> None:
        addresses = self._census.take(now_s, self.observer.silent)
        self.can_count = addresses is not None
        self.observer.expect(addresses or {})

    def _greet(self, now_s: float) -> None:
        if self._greetings and now_s >= self._start_s + self._greetings[0]:
            del self._greetings[0]
            self._greet_distant()

    def _greet_distant(self) -> None:
        if self._reach.is_wide:
            for host in self._hosts:
                self._greet_through(host)
        for peer in self._peers:
            for port in unicast_ports(self._reach.domain_id)[:PEERS_PER_HOST]:
                self.observer.greet((peer, port))

    def _greet_through(self, host: str) -> None:
        """Greet all participants by multicast on an interface, which may have disappeared."""
        with suppress(OSError):
            interface = socket.inet_aton(host)
            self._socket.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, interface)
            self.observer.greet((MULTICAST_ADDRESS, multicast_port(self._reach.domain_id)))


def _address(peer: str) -> str:
    try:
        return socket.gethostbyname(peer)
    except (OSError, UnicodeError) as error:
        raise RuntimeError(
            f"ROS_STATIC_PEERS names '{peer}', which cannot be resolved ({error}), so no "
            'node can start, either; use its IP address, or: unset ROS_STATIC_PEERS'
        ) from error


def _own_hosts(reach: Reach) -> list[str]:
    """Return the addresses of this machine at which other participants reach it."""
    if reach.is_local:
        return [THIS_HOST]
    return _network_addresses() or [THIS_HOST]


def _network_addresses() -> list[str]:
    """Return the addresses of this machine in networks."""
    found = [each.address for each in read_interfaces() if each.is_up and not each.is_loopback]
    return [address for address in found if address]
