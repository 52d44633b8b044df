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
import os

from ros2cli.rtps.entities import RELIABLE, TOPIC, TRANSIENT_LOCAL, TYPE_NAME
from ros2cli.rtps.identifiers import (
    BUILTIN_ENDPOINTS,
    ENTITIES_READER,
    PARTICIPANT,
    PARTICIPANTS_WRITER,
    PID_BUILTIN_ENDPOINTS,
    PID_DEFAULT_UNICAST_LOCATOR,
    PID_DURABILITY,
    PID_ENDPOINT_GUID,
    PID_KEY_HASH,
    PID_LEASE_DURATION,
    PID_METATRAFFIC_UNICAST_LOCATOR,
    PID_PARTICIPANT_GUID,
    PID_PROTOCOL_VERSION,
    PID_RELIABILITY,
    PID_STATUS_INFO,
    PID_TOPIC_NAME,
    PID_TYPE_NAME,
    PID_VENDOR_ID,
    PREFIX_BYTES,
    PROTOCOL_VERSION,
    SUBSCRIPTIONS_READER,
    SUBSCRIPTIONS_WRITER,
    UNKNOWN_ENTITY,
    VENDOR_UNKNOWN,
)
from ros2cli.rtps.message import Data, data, heartbeat, message, sender, Submessage, submessages
from ros2cli.rtps.neighbour import Neighbour
from ros2cli.rtps.parameters import (
    Address,
    decode_parameters,
    duration_value,
    encode_inline,
    encode_parameters,
    locator_value,
    number_value,
    Parameters,
    text_value,
    THIS_HOST,
)

LEASE_S = 10
DISPOSED = b'\0\0\0\3'
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
        self._prefix = new_prefix()
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
        discovery = described.ports(PID_METATRAFFIC_UNICAST_LOCATOR)
        user = described.ports(PID_DEFAULT_UNICAST_LOCATOR)
        if not discovery or not user:
            return
        address = (host, discovery[0])
        if host == THIS_HOST and address not in self._expected:
            return
        for each in self.neighbours:
            if each.discovery == address:
                del self._neighbours[each.prefix]
        self._neighbours[prefix] = met = Neighbour(self._prefix, prefix, address, (host, user[0]))
        met.heard_s = self._now_s
        met.lease_s = described.duration_ns(PID_LEASE_DURATION) / 10**9
        if self._silent.pop(address, None) is None:
            self.greet(address)  # multicast announces participants to it, but not readers


def new_prefix() -> bytes:
    """Return a new unique GUID prefix for us."""
    return VENDOR_UNKNOWN + os.urandom(PREFIX_BYTES - len(VENDOR_UNKNOWN))


def greeting(prefix: bytes, addresses: Sequence[Address]) -> bytes:
    """
    Build the datagram that makes a participant describe itself to us.

    Parameters
    ----------
    prefix
        Our GUID prefix (12 bytes).
    addresses
        The addresses at which others reach our socket.

    """
    return message(
        prefix,
        data(UNKNOWN_ENTITY, PARTICIPANTS_WRITER, 1, _participant(prefix, addresses)),
        data(SUBSCRIPTIONS_READER, SUBSCRIPTIONS_WRITER, 1, _reader(prefix)),
        heartbeat(SUBSCRIPTIONS_READER, SUBSCRIPTIONS_WRITER, 1, 1, 1),
    )


def farewell(prefix: bytes) -> bytes:
    """
    Build the datagram that makes a participant forget us.

    Parameters
    ----------
    prefix
        Our GUID prefix (12 bytes).

    """
    guid = prefix + PARTICIPANT
    qos = encode_inline([(PID_KEY_HASH, guid), (PID_STATUS_INFO, DISPOSED)])
    key = encode_parameters([(PID_PARTICIPANT_GUID, guid)])
    return message(prefix, data(UNKNOWN_ENTITY, PARTICIPANTS_WRITER, 2, key, qos))


def _participant(prefix: bytes, addresses: Sequence[Address]) -> bytes:
    locators = [locator_value(address) for address in addresses]
    return encode_parameters(
        [
            (PID_PROTOCOL_VERSION, PROTOCOL_VERSION),
            (PID_VENDOR_ID, VENDOR_UNKNOWN),
            (PID_PARTICIPANT_GUID, prefix + PARTICIPANT),
            *((PID_METATRAFFIC_UNICAST_LOCATOR, locator) for locator in locators),
            *((PID_DEFAULT_UNICAST_LOCATOR, locator) for locator in locators),
            (PID_LEASE_DURATION, duration_value(LEASE_S)),
            (PID_BUILTIN_ENDPOINTS, number_value(BUILTIN_ENDPOINTS)),
        ]
    )


def _reader(prefix: bytes) -> bytes:
    guid = prefix + ENTITIES_READER
    return encode_parameters(
        [
            (PID_PARTICIPANT_GUID, prefix + PARTICIPANT),
            (PID_ENDPOINT_GUID, guid),
            (PID_KEY_HASH, guid),
            (PID_TOPIC_NAME, text_value(TOPIC)),
            (PID_TYPE_NAME, text_value(TYPE_NAME)),
            (PID_RELIABILITY, number_value(RELIABLE) + duration_value(0)),
            (PID_DURABILITY, number_value(TRANSIENT_LOCAL)),
        ]
    )
