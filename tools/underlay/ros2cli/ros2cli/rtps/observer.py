# SPDX-License-Identifier: Apache-2.0
"""
Observer that announces itself to all participants and queries them, one after the other.

Each answers with dozens of datagrams; if all answered at once, our socket would overflow and most
would have to be sent again, which takes seconds. The observer is a participant without nodes, with
a reader of `ros_discovery_info`. It appears in no list: `ros2` commands and rclpy ignore
participants that announce no enclave.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress

from ros2cli.rtps.announcement import farewell, greeting, LEASE_S, new_prefix
from ros2cli.rtps.identifiers import (
    PARTICIPANTS_WRITER,
    PID_DEFAULT_UNICAST_LOCATOR,
    PID_LEASE_DURATION,
    PID_METATRAFFIC_UNICAST_LOCATOR,
    VENDOR_UNKNOWN,
)
from ros2cli.rtps.message import Data, sender, Submessage, submessages
from ros2cli.rtps.neighbour import endpoint_streams, Neighbour
from ros2cli.rtps.parameters import Address, decode_parameters, Parameters, THIS_HOST

PACE_S = 0.004
GREET_AGAIN_S = 0.1
NEVER_S = float('-inf')


class Observer:
    """
    Collects the endpoints and nodes that the participants of a domain announce.

    Parameters
    ----------
    addresses
        The addresses at which others reach our socket.
    send
        Sends a datagram to an address; the only output of the observer.

    """

    def __init__(
        self, addresses: Sequence[Address], send: Callable[[bytes, Address], None]
    ) -> None:
        self._prefix = new_prefix(VENDOR_UNKNOWN)
        self._greeting = greeting(self._prefix, addresses)
        self._send = send
        self._neighbours: dict[bytes, Neighbour] = {}
        self._expected: dict[Address, str] = {}
        self._silent: dict[Address, float] = {}  # unanswered addresses, and when they were greeted
        self._next_greeting_s = NEVER_S
        self._alive_s = self._now_s = NEVER_S
        self._latest = b''

    @property
    def neighbours(self) -> list[Neighbour]:
        """The participants that have answered."""
        return list(self._neighbours.values())

    @property
    def silent(self) -> list[Address]:
        """The addresses of expected participants that have not answered."""
        return list(self._silent)

    @property
    def missing(self) -> int:
        """The number of known participants that are incomplete."""
        return len(self._silent) + sum(not each.is_complete for each in self.neighbours)

    @property
    def is_complete(self) -> bool:
        """Whether all known participants are complete."""
        return not self.missing

    @property
    def due_s(self) -> float:
        """The time of the next transmission."""
        greeting_s = min(self._silent.values(), default=float('inf')) + GREET_AGAIN_S
        question_s = min((each.due_s for each in self.neighbours), default=float('inf'))
        return min(max(greeting_s, self._next_greeting_s), question_s)

    def expect(self, present: Mapping[Address, str]) -> None:
        """
        Set the participants on this machine; those that have left are forgotten.

        Parameters
        ----------
        present
            Their addresses, without our own, each with an identifier that distinguishes it from a
            later participant at the same address.

        """
        before, self._expected = self._expected, dict(present)
        stayed = {address for address in present if present[address] == before.get(address)}
        for each in self.neighbours:
            if each.is_here and each.discovery not in stayed:
                del self._neighbours[each.prefix]
        answered = {each.discovery for each in self.neighbours}
        self._silent = {
            address: self._silent.get(address, NEVER_S) if address in stayed else NEVER_S
            for address in present.keys() - answered
        }

    def greet(self, address: Address) -> None:
        """
        Request the participants at an address to describe themselves.

        Parameters
        ----------
        address
            The host and UDP port, of a participant or of the multicast group.

        """
        self._send(self._greeting, address)

    def ask(self, now_s: float) -> None:
        """
        Send what is due: the next greeting, requests, and keep-alive messages.

        Parameters
        ----------
        now_s
            The current time of a monotonic clock, in s.

        """
        self._now_s = now_s
        self._forget_lost()
        for address, greeted_s in self._silent.items():
            if max(greeted_s + GREET_AGAIN_S, self._next_greeting_s) <= now_s:
                self.greet(address)
                self._silent[address] = now_s
                self._next_greeting_s = now_s + PACE_S
        for neighbour in self.neighbours:
            if neighbour.due_s <= now_s:
                if not neighbour.knows_reader:
                    self.greet(neighbour.discovery)
                for datagram, address in neighbour.requests(now_s):
                    self._send(datagram, address)
        if now_s - self._alive_s > LEASE_S / 4:
            self._alive_s = now_s
            for neighbour in self.neighbours:
                self.greet(neighbour.discovery)

    def handle(self, datagram: bytes, host: str) -> None:
        """
        Handle a datagram; a damaged one is dropped.

        Parameters
        ----------
        datagram
            The datagram as it was received.
        host
            The IP address of the sender; THIS_HOST if it is on this machine.

        """
        prefix = sender(datagram)
        if prefix is None or prefix == self._prefix or datagram == self._latest:
            return
        if prefix in self._neighbours:
            self._neighbours[prefix].heard_s = self._now_s
        self._latest = datagram  # often received a second time, through another interface
        with suppress(ValueError):
            for news in submessages(datagram, self._prefix):
                self._handle(news, prefix, host)

    def leave(self) -> None:
        """Send farewells to all participants, so that they release our state."""
        addresses = {each.discovery for each in self.neighbours}
        greeted = {address for address, when in self._silent.items() if when > NEVER_S}
        for address in addresses | greeted:
            self._send(farewell(self._prefix), address)

    def _forget_lost(self) -> None:
        """Remove participants on other machines whose lease has expired."""
        for each in self.neighbours:
            if not each.is_here and self._now_s > each.heard_s + max(each.lease_s, LEASE_S):
                del self._neighbours[each.prefix]

    def _handle(self, news: Submessage, prefix: bytes, host: str) -> None:
        if news.writer != PARTICIPANTS_WRITER:
            if prefix in self._neighbours:
                self._neighbours[prefix].handle(news)
        elif isinstance(news, Data) and news.is_disposed:
            self._neighbours.pop(prefix, None)
        elif isinstance(news, Data) and prefix not in self._neighbours:
            self._meet(prefix, host, decode_parameters(news.payload))

    def _meet(self, prefix: bytes, host: str, described: Parameters) -> None:
        discovery = described.addresses(PID_METATRAFFIC_UNICAST_LOCATOR)
        user = described.addresses(PID_DEFAULT_UNICAST_LOCATOR)
        if not discovery or not user:
            return
        address = (host, discovery[0][1])
        if host == THIS_HOST and address not in self._expected:
            return
        for each in self.neighbours:
            if each.discovery == address:
                del self._neighbours[each.prefix]
        met = Neighbour(self._prefix, prefix, address, (host, user[0][1]), endpoint_streams())
        self._neighbours[prefix] = met
        met.heard_s = self._now_s
        met.lease_s = described.duration_ns(PID_LEASE_DURATION) / 10**9
        if self._silent.pop(address, None) is None:
            self.greet(address)  # multicast announces participants to it, but not readers
