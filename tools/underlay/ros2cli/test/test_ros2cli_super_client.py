# SPDX-License-Identifier: Apache-2.0
"""Tests of the super client, with a discovery server in a network of our own."""

from __future__ import annotations

import struct

import pytest
from ros2cli.rtps.identifiers import (
    PARTICIPANT,
    PARTICIPANTS_READER,
    PARTICIPANTS_WRITER,
    PID_DEFAULT_UNICAST_LOCATOR,
    PID_METATRAFFIC_UNICAST_LOCATOR,
    PID_PARTICIPANT_GUID,
    PID_STATUS_INFO,
    PID_USER_DATA,
    PUBLICATIONS_READER,
    PUBLICATIONS_WRITER,
    SUBSCRIPTIONS_READER,
    SUBSCRIPTIONS_WRITER,
)
from ros2cli.rtps.message import data, heartbeat, message
from ros2cli.rtps.parameters import (
    Address,
    encode_inline,
    encode_parameters,
    locator_value,
    text_value,
    THIS_HOST,
)
from ros2cli.rtps.super_client import server_prefix, SuperClient
from rtps_network import ACKNACK, DATA, DISTANT_HOST, HEADER_BYTES, Network, OBSERVER, Participant

SERVER: Address = ('10.0.0.1', 11811)
BRIDGE = '172.17.0.1'
READERS = {
    PARTICIPANTS_WRITER: PARTICIPANTS_READER,
    PUBLICATIONS_WRITER: PUBLICATIONS_READER,
    SUBSCRIPTIONS_WRITER: SUBSCRIPTIONS_READER,
}
ENTITIES_WRITER = bytes.fromhex('00000103')
PAYLOAD_OFFSET = 24
LONG_S = 30.0


class ServerNetwork(Network):
    """A network whose participants are known only to a discovery server, as that of Fast DDS."""

    def __init__(self, *, loss: float = 0.0, seed: int = 0) -> None:
        super().__init__(loss=loss, seed=seed)
        self.client = SuperClient(
            [OBSERVER], [THIS_HOST, BRIDGE], {0: SERVER}, self._to_server_or_participant
        )
        self.observer = self.client
        self.is_running = True
        self.left = False
        self._described: dict[bytes, list[bytes]] = {writer: [] for writer in READERS}
        self._has_acknowledged = False

    def describe(self, participant: Participant, *hosts: str) -> None:
        """Tell the server of a participant at some addresses, and of its endpoints."""
        locators = [locator_value((host, participant.port)) for host in hosts]
        users = [locator_value((host, participant.port + 1)) for host in hosts]
        self._tell(
            PARTICIPANTS_WRITER,
            encode_parameters(
                [
                    (PID_PARTICIPANT_GUID, participant.prefix + PARTICIPANT),
                    *((PID_METATRAFFIC_UNICAST_LOCATOR, each) for each in locators),
                    *((PID_DEFAULT_UNICAST_LOCATOR, each) for each in users),
                    (PID_USER_DATA, text_value('enclave=/;')),
                ]
            ),
        )
        for writer in (PUBLICATIONS_WRITER, SUBSCRIPTIONS_WRITER):
            for parts in participant._samples[writer].values():
                self._tell(writer, parts[0][PAYLOAD_OFFSET:])

    def forget(self, participant: Participant) -> None:
        """Tell the client that a participant has left."""
        key = encode_parameters([(PID_PARTICIPANT_GUID, participant.prefix + PARTICIPANT)])
        gone = encode_inline([(PID_STATUS_INFO, b'\0\0\0\3')])
        ends = READERS[PARTICIPANTS_WRITER], PARTICIPANTS_WRITER
        number = len(self._described[PARTICIPANTS_WRITER]) + 1
        self._described[PARTICIPANTS_WRITER].append(data(*ends, number, key, gone, is_key=True))
        self._announce(PARTICIPANTS_WRITER)

    def _tell(self, writer: bytes, payload: bytes) -> None:
        samples = self._described[writer]
        samples.append(data(READERS[writer], writer, len(samples) + 1, payload))

    def _to_server_or_participant(self, datagram: bytes, address: Address) -> None:
        if address != SERVER:
            self._to_participant(datagram, address)
        elif self.is_running and self._random.random() >= self._loss:
            self._receive(datagram)

    def _receive(self, datagram: bytes) -> None:
        offset = HEADER_BYTES
        while offset < len(datagram):
            kind, _, size = struct.unpack_from('<BBH', datagram, offset)
            start, offset = offset + 4, offset + 4 + size
            body = datagram[start:offset]
            if kind == DATA and body[8:12] == PARTICIPANTS_WRITER:
                self.left |= b'\0\0\0\3' in body
                self._introduce()
            elif kind == ACKNACK and body[4:8] in READERS:
                self._answer(body)

    def _introduce(self) -> None:
        """Announce the participants, and have them tell of their nodes."""
        for writer in READERS:
            self._announce(writer)
        for participant in self.participants.values():
            participant._knows_reader = True
            participant._tell(ENTITIES_WRITER)

    def _announce(self, writer: bytes) -> None:
        """Say how many samples there are: no endpoints until all participants are known."""
        is_open = writer == PARTICIPANTS_WRITER or self._has_acknowledged
        last = len(self._described[writer]) if is_open else 0
        self._send(heartbeat(READERS[writer], writer, 1, last, 1))

    def _answer(self, body: bytes) -> None:
        writer = body[4:8]
        base, size = struct.unpack_from('<II', body, 12)
        words = struct.unpack_from(f'<{(size + 31) // 32}I', body, 20)
        for i in range(size):
            if words[i // 32] & 1 << (31 - i % 32):
                self._send(self._described[writer][base + i - 1])
        if writer == PARTICIPANTS_WRITER and base > len(self._described[writer]):
            self._has_acknowledged = True
            self._announce(PUBLICATIONS_WRITER)
            self._announce(SUBSCRIPTIONS_WRITER)

    def _send(self, part: bytes) -> None:
        self.to_observer(message(server_prefix(0), part), SERVER[0])


def names(network: Network) -> list[str]:
    """Return the names of the nodes that are known, sorted."""
    return sorted(name for name, _ in network.graph.get_node_names_and_namespaces())


@pytest.mark.parametrize(('loss', 'seed'), [(0.0, 0), *((0.4, seed) for seed in range(10))])
def test_a_server_tells_everything(loss: float, seed: int) -> None:
    """When the client believes that it knows all, it does, whatever was lost on the way."""
    network = ServerNetwork(loss=loss, seed=seed)
    for index, host in enumerate((THIS_HOST, DISTANT_HOST, DISTANT_HOST)):
        network.describe(network.add(index, nodes=2, topics=['a'], host=host), host)
    assert not network.client.is_complete
    assert network.run(LONG_S) < LONG_S
    assert names(network) == [f'node{index}_{node}' for index in range(3) for node in range(2)]
    found = dict(network.graph.get_topic_names_and_types())
    assert [*found] == ['/a', '/in0', '/in1', '/in2']
    assert network.graph.count_publishers('/a') == 6
    assert sum(each.is_here for each in network.client.neighbours) == 1
    assert network.client.answered == [0]


def test_a_server_without_participants() -> None:
    """There is nothing to wait for, once it has said so; one that is silent is waited for."""
    network = ServerNetwork()
    network.is_running = False
    assert network.run(1.0) >= 1.0
    assert not network.client.answered
    network.is_running = True
    assert network.run(LONG_S) < 1.2
    assert names(network) == []


def test_participants_leave() -> None:
    """One leaves, one is killed on this machine; another machine's port says nothing here."""
    network = ServerNetwork()
    added = [network.add(index, host=THIS_HOST) for index in range(3)]
    for participant, host in zip(added, (THIS_HOST, THIS_HOST, DISTANT_HOST), strict=True):
        participant.host = host
        network.describe(participant, host)
    network.run(LONG_S)
    assert names(network) == ['node0_0', 'node1_0', 'node2_0']
    network.forget(added[0])
    end_s = network.now_s + 1.0
    while network.now_s < end_s:
        network.step()
    assert names(network) == ['node1_0', 'node2_0']
    network.client.keep({added[1].port})
    assert names(network) == ['node1_0', 'node2_0']
    network.client.keep(set())
    assert names(network) == ['node2_0']


def test_a_killed_participant_is_replaced() -> None:
    """The server goes on to tell of it; the one that has its port now is there, and answers."""
    network = ServerNetwork()
    killed, present = (network.add(index, host=THIS_HOST) for index in range(2))
    del network.participants[present.port]
    present.port = killed.port
    network.participants[present.port] = present
    for each in (killed, present):
        network.describe(each, THIS_HOST)
    assert network.run(LONG_S) < LONG_S
    assert names(network) == ['node1_0']


def test_a_killed_participant_that_is_told_of_late() -> None:
    """The one that has its port now has answered already: it is asked once more, and stays."""
    network = ServerNetwork()
    killed, present = (network.add(index, host=THIS_HOST) for index in range(2))
    del network.participants[present.port]
    present.port = killed.port
    network.participants[present.port] = present
    network.describe(present, THIS_HOST)
    network.run(LONG_S)
    assert network.client.is_complete and names(network) == ['node1_0']
    network.describe(killed, THIS_HOST)
    for writer in READERS:
        network._announce(writer)
    end_s = network.now_s + 1.0
    while network.now_s < end_s:
        network.step()
    assert network.client.is_complete and names(network) == ['node1_0']


def test_machines_with_an_address_in_common() -> None:
    """The bridge of Docker has the same address everywhere: its machine is one of the others."""
    network = ServerNetwork()
    network.describe(network.add(0, host=DISTANT_HOST), BRIDGE, DISTANT_HOST)
    network.run(LONG_S)
    [found] = network.client.neighbours
    assert not found.is_here
    network.client.keep(set())
    assert names(network) == ['node0_0']


def test_farewell() -> None:
    """The server is told that the client has gone; before the first greeting there is no need."""
    network = ServerNetwork()
    network.client.leave()
    assert not network.left
    network.run(LONG_S)
    network.client.leave()
    assert network.left


def test_damaged_datagrams() -> None:
    """What is damaged, or comes from a stranger, changes nothing."""
    network = ServerNetwork()
    network.describe(network.add(0, host=DISTANT_HOST), DISTANT_HOST)
    network.run(LONG_S)
    bad = data(PARTICIPANTS_READER, PARTICIPANTS_WRITER, 9, b'\0\3\0\0\x50')
    for datagram in (b'', b'RTPS', message(server_prefix(0), bad), message(server_prefix(7), bad)):
        network.client.handle(datagram, SERVER[0])
    assert names(network) == ['node0_0']
