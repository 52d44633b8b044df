# SPDX-License-Identifier: Apache-2.0
"""
Super client of discovery servers: they tell it about all participants and their endpoints.

A discovery server of Fast DDS replaces the discovery among participants: each of them, a client,
tells the server about itself, and the server tells it only about those with which it shares a
topic. A super client is told everything. The nodes of a participant it learns from the
participant itself, as an observer does.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Collection, Sequence
from contextlib import suppress

from ros2cli.rtps.announcement import farewell, greeting, LEASE_S, new_prefix
from ros2cli.rtps.entities import guid_of
from ros2cli.rtps.identifiers import (
    PARTICIPANTS_READER,
    PARTICIPANTS_WRITER,
    PID_DEFAULT_UNICAST_LOCATOR,
    PID_KEY_HASH,
    PID_METATRAFFIC_UNICAST_LOCATOR,
    PID_PARTICIPANT_GUID,
    PID_USER_DATA,
    PREFIX_BYTES,
    VENDOR_EPROSIMA,
)
from ros2cli.rtps.message import Data, sender, submessages
from ros2cli.rtps.neighbour import endpoint_streams, Neighbour
from ros2cli.rtps.parameters import Address, decode_parameters, Parameters, THIS_HOST
from ros2cli.rtps.stream import Stream

GREET_AGAIN_S = 0.1
NEVER_S = float('-inf')
NUMBER_BYTE = slice(2, 3)
ENCLAVE = b'enclave='  # announced by participants of ROS


def server_prefix(number: int) -> bytes:
    """
    Return the GUID prefix (12 bytes) of a discovery server.

    Parameters
    ----------
    number
        Its ID, which is its position in ROS_DISCOVERY_SERVER: 0 to 255.

    """
    return b'DS' + bytes([number]) + b'_EPROSIMA'


def server_number(prefix: bytes) -> int | None:
    """
    Return the ID of a discovery server; None if the GUID prefix is none of a server.

    Parameters
    ----------
    prefix
        The GUID prefix (12 bytes).

    """
    number = prefix[NUMBER_BYTE]
    return number[0] if number and prefix == server_prefix(number[0]) else None


class _Server(Neighbour):
    """
    A discovery server, which describes its clients instead of itself.

    Parameters
    ----------
    own_prefix
        Our GUID prefix (12 bytes).
    number
        The ID of the server.
    address
        Its address.
    hear
        Called with each sample from it: a participant, a reader or a writer.

    Attributes
    ----------
    is_awaited
        Whether it has more to describe. As it does so only when it has seen that we know all
        participants, this is acknowledged until it has arrived.

    """

    def __init__(
        self, own_prefix: bytes, number: int, address: Address, hear: Callable[[Data], None]
    ) -> None:
        participants = Stream(PARTICIPANTS_READER, PARTICIPANTS_WRITER)
        streams = [participants, *endpoint_streams()]
        super().__init__(own_prefix, server_prefix(number), address, address, streams)
        self.number = number
        self.is_awaited = False
        self._participants = participants
        self._hear = hear

    @property
    def due_s(self) -> float:
        """The time of the next request or acknowledgement."""
        return self._ask_again_s if self.is_awaited else super().due_s

    @property
    def has_answered(self) -> bool:
        """Whether it has said how many participants it knows."""
        return self._participants.is_announced

    def on_described(self, sample: Data) -> None:
        """
        Pass a description on.

        Parameters
        ----------
        sample
            The sample of a built-in writer of the server.

        """
        self._hear(sample)


class SuperClient:
    """
    Collects the endpoints and nodes of all participants that discovery servers know.

    Parameters
    ----------
    addresses
        The addresses at which others reach our socket.
    hosts
        All IP addresses of this machine.
    servers
        The addresses of the servers by their IDs.
    send
        Sends a datagram to an address; the only output.

    """

    def __init__(
        self,
        addresses: Sequence[Address],
        hosts: Collection[str],
        servers: dict[int, Address],
        send: Callable[[bytes, Address], None],
    ) -> None:
        self._prefix = new_prefix(VENDOR_EPROSIMA)
        self._greeting = greeting(self._prefix, addresses)
        self._hosts = frozenset(hosts)
        self._send = send
        found = (_Server(self._prefix, each, servers[each], self._hear) for each in servers)
        self._servers = {each.prefix: each for each in found}
        self._clients: dict[bytes, Neighbour] = {}
        self._early: dict[bytes, dict[bytes, Data]] = defaultdict(dict)
        self._with_nodes: set[bytes] = set()
        self._greeting_due_s = NEVER_S
        self._latest = b''

    @property
    def neighbours(self) -> list[Neighbour]:
        """The participants that the servers have described."""
        return list(self._clients.values())

    @property
    def answered(self) -> list[int]:
        """The IDs of the servers that have answered."""
        return [each.number for each in self._servers.values() if each.has_answered]

    @property
    def missing(self) -> int:
        """The number of incomplete participants and servers; 1 if no server has answered."""
        incomplete = sum(not each.is_complete for each in self._met)
        return incomplete + len(self._untold) if self.answered else 1

    @property
    def is_complete(self) -> bool:
        """Whether a server has answered, and all that was announced is known."""
        return not self.missing

    @property
    def due_s(self) -> float:
        """The time of the next transmission."""
        return min([self._greeting_due_s, *(each.due_s for each in self._met)])

    @property
    def _met(self) -> list[Neighbour]:
        """The servers that have answered, and the participants."""
        servers = [each for each in self._servers.values() if each.has_answered]
        return [*servers, *self._clients.values()]

    @property
    def _untold(self) -> list[Neighbour]:
        """
        The participants with nodes whose readers or writers no server has described.

        Each has some, but a server first says that there are none.
        """
        return [
            each
            for prefix, each in self._clients.items()
            if prefix in self._with_nodes
            and len({end.is_writer for end in each.endpoints.values()}) < 2
        ]

    def keep(self, open_ports: Collection[int]) -> None:
        """
        Forget the participants on this machine that have been killed, or are our own.

        Parameters
        ----------
        open_ports
            The UDP ports of other processes on this machine.

        """
        for each in self.neighbours:
            if each.is_here and each.discovery[1] not in open_ports:
                del self._clients[each.prefix]

    def ask(self, now_s: float) -> None:
        """
        Send what is due: greetings and requests.

        Parameters
        ----------
        now_s
            The current time of a monotonic clock, in s.

        """
        if now_s >= self._greeting_due_s:
            is_known = all(each.has_answered for each in self._servers.values())
            is_known &= all(each.knows_reader for each in self.neighbours)
            self._greeting_due_s = now_s + (LEASE_S / 4 if is_known else GREET_AGAIN_S)
            for server in self._servers.values():
                self._send(self._greeting, server.discovery)
        for server in self._servers.values():
            server.is_awaited = bool(self._untold)
        for each in self._met:
            if each.due_s <= now_s:
                for datagram, address in each.requests(now_s):
                    self._send(datagram, address)

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
        if prefix is None or datagram == self._latest:
            return
        self._latest = datagram  # often received a second time, through another interface
        found = self._servers.get(prefix) or self._clients.get(prefix)
        if found is None:
            return
        if prefix in self._clients:
            found.found_at(host)
            self._forget_predecessors(found)
        with suppress(ValueError):
            for news in submessages(datagram, self._prefix):
                found.handle(news)

    def leave(self) -> None:
        """Send farewells to the servers, so that they and their clients forget us."""
        if self._greeting_due_s > NEVER_S:
            for each in self._servers.values():
                self._send(farewell(self._prefix), each.discovery)

    def _forget_predecessors(self, found: Neighbour) -> None:
        """Forget what had the port of a participant on this machine before: it was killed."""
        for each in self.neighbours if found.is_here else ():
            if each is not found and each.discovery == found.discovery:
                del self._clients[each.prefix]

    def _hear(self, sample: Data) -> None:
        """Handle what a server describes: a participant, a reader or a writer."""
        if sample.writer == PARTICIPANTS_WRITER:
            self._hear_of_participant(sample)
            return
        described = _described(sample)
        guid = guid_of(described)
        client = self._clients.get(guid[:PREFIX_BYTES])
        if client:
            client.on_described(sample)
        elif not sample.is_disposed:
            self._early[guid[:PREFIX_BYTES]][guid] = sample
        else:
            self._early[guid[:PREFIX_BYTES]].pop(guid, None)

    def _hear_of_participant(self, sample: Data) -> None:
        described = _described(sample)
        guid = described.first(PID_PARTICIPANT_GUID) or described.first(PID_KEY_HASH)
        prefix = guid[:PREFIX_BYTES]
        if sample.is_disposed:
            self._clients.pop(prefix, None)
            self._early.pop(prefix, None)
        elif prefix not in (self._prefix, *self._servers, *self._clients):
            self._meet(prefix, described)

    def _meet(self, prefix: bytes, described: Parameters) -> None:
        discovery = described.addresses(PID_METATRAFFIC_UNICAST_LOCATOR)
        user = described.addresses(PID_DEFAULT_UNICAST_LOCATOR)
        if not discovery or not user:
            return
        # Several machines may have an address in common, such as that of Docker's bridge.
        elsewhere = [host for host, _ in discovery if host not in self._hosts]
        client = Neighbour(self._prefix, prefix, discovery[0], user[0], [])
        client.found_at(elsewhere[0] if elsewhere else THIS_HOST)
        # One of those that have this port was killed: which of them answers?
        for each in self.neighbours if client.is_here else ():
            if each.discovery == client.discovery:
                each.ask_again()
        self._clients[prefix] = client
        if described.octets(PID_USER_DATA).startswith(ENCLAVE):
            self._with_nodes.add(prefix)
        for sample in self._early.pop(prefix, {}).values():
            client.on_described(sample)


def _described(sample: Data) -> Parameters:
    """Return the parameters of a sample; of a disposal, those that identify what has ended."""
    return decode_parameters(sample.payload) if sample.payload else sample.inline
