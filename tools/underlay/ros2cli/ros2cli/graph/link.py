# SPDX-License-Identifier: Apache-2.0
"""UDP transport of the discovery observer."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from contextlib import suppress
import select
import socket
import time

from ros2cli.graph.census import Census
from ros2cli.graph.reach import OFF, Reach, read_interfaces
from ros2cli.rtps.identifiers import MULTICAST_ADDRESS, multicast_port, unicast_ports
from ros2cli.rtps.observer import Observer
from ros2cli.rtps.parameters import Address, THIS_HOST

COUNT_PERIOD_S = 0.1
GREETINGS_S = (0.0, 0.1, 0.25)  # of uncounted participants, since a greeting may be lost
PEERS_PER_HOST = 32
MAX_DATAGRAM_BYTES = 65536
RECEIVE_BUFFER_BYTES = 1 << 20
HANDLED_AT_ONCE = 1000
READ_AT_ONCE = 64  # between two that are handled, so that a flood does not block us
MAX_WAITING = 4096


class Link:
    """
    UDP socket that carries the datagrams of an observer; nothing is sent before `exchange`.

    Parameters
    ----------
    reach
        The domain and the discovery range.

    Attributes
    ----------
    observer
        The observer that collects the received descriptions.
    can_count
        Whether it is known how many participants this machine has.

    Raises
    ------
    RuntimeError
        The address of a static peer cannot be found.

    """

    def __init__(self, reach: Reach) -> None:
        self._reach = reach
        self._hosts = _own_hosts(reach)
        self._peers = [_address(peer) for peer in reach.peers]
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, RECEIVE_BUFFER_BYTES)
        self._socket.bind((THIS_HOST if reach.is_local else '', 0))
        self._socket.setblocking(False)
        port = self._socket.getsockname()[1]
        self.observer = Observer([(host, port) for host in self._hosts], self._send)
        self.can_count = True
        self._census = Census(reach.domain_id)
        self._waiting: deque[tuple[bytes, str]] = deque()
        self._start_s = self._count_s = time.monotonic()
        self._greetings = list(GREETINGS_S)

    @property
    def is_hopeless(self) -> bool:
        """Whether stopped processes are the only participants that have not answered."""
        silent = self.observer.silent
        return len(silent) == self.observer.missing and self._census.are_stopped(silent)

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
            self._count(now_s)
        if self._greetings and now_s >= self._start_s + self._greetings[0]:
            del self._greetings[0]
            self._greet_distant()
        self.observer.ask(now_s)
        if not self._waiting:
            wait_s = min(self.observer.due_s, self._count_s) - now_s if waits else 0.0
            select.select([self._socket], [], [], max(0.0, wait_s))
        self._receive()

    def _count(self, now_s: float) -> None:
        self._count_s = now_s + COUNT_PERIOD_S
        addresses = self._census.take(now_s, self.observer.silent)
        self.can_count = addresses is not None
        self.observer.expect(addresses or {})

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
    found = [each.address for each in read_interfaces() if each.is_up and not each.is_loopback]
    return [address for address in found if address] or [THIS_HOST]
