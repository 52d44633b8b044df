# SPDX-License-Identifier: Apache-2.0
"""Tests of reading the graph from participants, in a network of our own."""

import random
import struct

import pytest
from ros2cli.rtps.entities import decode_entities
from ros2cli.rtps.identifiers import (
    MULTICAST_ADDRESS,
    PARTICIPANTS_WRITER,
    PID_DEFAULT_UNICAST_LOCATOR,
    PID_ENDPOINT_GUID,
    PID_LIVELINESS,
    PID_METATRAFFIC_UNICAST_LOCATOR,
    PID_RELIABILITY,
    PID_TOPIC_NAME,
    PID_USER_DATA,
    PUBLICATIONS_READER,
    PUBLICATIONS_WRITER,
    unicast_ports,
    UNKNOWN_ENTITY,
)
from ros2cli.rtps.message import (
    acknack,
    data,
    Gap,
    Heartbeat,
    heartbeat,
    message,
    submessages,
)
from ros2cli.rtps.parameters import (
    decode_parameters,
    encode_parameters,
    INFINITE_NS,
    PID_SENTINEL,
    text_of,
    THIS_HOST,
)
from ros2cli.rtps.stream import MAX_AHEAD, Stream
from rtps_network import DISTANT_HOST, gap, Network

LONG_S = 30.0


def names(network: Network) -> list[str]:
    """Return the names of the nodes that are known, sorted."""
    return sorted(name for name, _ in network.graph.get_node_names_and_namespaces())


def topics(network: Network) -> list[str]:
    """Return the names of the topics that are known, sorted."""
    return [name for name, _ in network.graph.get_topic_names_and_types()]


def test_everything_is_told() -> None:
    """Nodes, topics, types, owners and quality of service arrive as they were announced."""
    network = Network()
    network.add(0, nodes=2, topics=['a', 'b'])
    network.count()
    assert not network.observer.is_complete
    network.run(LONG_S)
    assert names(network) == ['node0_0', 'node0_1']
    assert topics(network) == ['/a', '/b', '/in0']
    of_node = network.graph.get_publisher_names_and_types_by_node('node0_1', '/')
    assert of_node == [('/a', ['std_msgs/msg/String']), ('/b', ['std_msgs/msg/String'])]
    assert network.graph.count_publishers('/a') == 2
    end, *_ = network.observer.neighbours[0].endpoints.values()
    assert end.type_hash.startswith('RIHS01_abab')
    assert (end.qos.reliability, end.qos.durability) == (2, 1)
    assert end.qos.deadline_ns == INFINITE_NS


def test_empty_machine_is_complete_at_once() -> None:
    """Where there is nobody, nobody is waited for."""
    network = Network()
    network.count()
    assert network.observer.is_complete


def test_small_socket_is_not_overrun() -> None:
    """Twenty processes answer so that no datagram is lost in a socket for a hundred of them."""
    network = Network(room=100)
    for index in range(20):
        network.add(index, topics=['a', 'b', 'c', 'd'])
    network.count()
    assert network.run(LONG_S) < 1.0
    assert len(names(network)) == 20
    assert network.dropped == 0


@pytest.mark.parametrize('seed', range(10))
def test_lost_datagrams_are_asked_again(seed: int) -> None:
    """Whatever is lost, in both directions, in the end everything is known."""
    network = Network(loss=0.4, seed=seed)
    for index in range(5):
        network.add(index, nodes=2, topics=['a', 'b', 'c'])
    network.count()
    network.run(LONG_S)
    assert network.observer.is_complete
    assert len(names(network)) == 10
    assert topics(network) == ['/a', '/b', '/c', *(f'/in{index}' for index in range(5))]
    assert network.dropped > 0


def test_silent_process_is_never_complete() -> None:
    """A process that is there but does not answer is known to be missing."""
    network = Network()
    network.add(0)
    network.count()
    network.observer.expect({(THIS_HOST, 7410): 'a', (THIS_HOST, 7412): 'b'})
    network.run(2.0)
    assert names(network) == ['node0_0']
    assert not network.observer.is_complete


def test_new_ends_are_heard() -> None:
    """What appears later is told by the participant; what is destroyed disappears."""
    network = Network()
    participant = network.add(0, topics=['a'])
    network.count()
    network.run(LONG_S)
    guid = participant.publish('rt/late')
    for _ in range(300):
        network.step()
    assert '/late' in topics(network)
    participant.destroy(guid)
    for _ in range(300):
        network.step()
    assert network.observer.is_complete
    assert '/late' not in topics(network)


def test_history_with_gaps() -> None:
    """Samples that a writer no longer has are not waited for."""
    network = Network()
    participant = network.add(0, topics=['a'])
    participant.destroy(participant.publish('rt/gone'))
    network.count()
    network.run(LONG_S)
    assert network.observer.is_complete
    assert topics(network) == ['/a', '/in0']


def test_large_process_is_asked_without_pause() -> None:
    """More endpoints than one request can name are asked for without a pause."""
    network = Network(room=10_000)
    network.add(0, topics=[f't{index}' for index in range(1200)])
    network.count()
    assert network.run(LONG_S) < 2.0
    assert len(topics(network)) == 1201


@pytest.mark.parametrize('loss', [0.0, 0.3])
def test_fragments_are_put_together(loss: float) -> None:
    """A process whose nodes have more endpoints than one datagram can name is complete."""
    network = Network(loss=loss, room=10_000)
    participant = network.add(0)
    guids = [participant.prefix + struct.pack('>HBB', index, 0, 3) for index in range(4000)]
    participant._nodes.append(('large', [], guids))
    participant._tell_entities()
    network.count()
    network.run(LONG_S)
    assert network.observer.is_complete
    assert names(network) == ['large', 'node0_0']
    assert [len(each.writers) for each in network.observer.neighbours[0].nodes] == [0, 4000]


@pytest.mark.parametrize('loss', [0.0, 0.4])
def test_distant_processes_are_greeted_themselves(loss: float) -> None:
    """Who was met by multicast tells its nodes at once, though it heard nothing of our reader."""
    network = Network(loss=loss)
    for index in range(3):
        network.add(index, topics=['a'], host=DISTANT_HOST)
    for _ in range(5):
        network.observer.greet((MULTICAST_ADDRESS, 7400))
        network.step()
    if not loss:
        assert network.run(2.0) < 1.0
    network.run(LONG_S)
    assert len(names(network)) == 3


def test_distant_process_is_lost_after_its_lease() -> None:
    """Who is on another machine is forgotten when it was silent for longer than it promised."""
    network = Network()
    network.add(0, host=DISTANT_HOST)._answer_greeting()
    network.step()
    network.run(2.0)
    network.participants.clear()
    network.now_s += 15.0
    network.step()
    assert names(network) == ['node0_0']
    network.now_s += 21.0
    network.step()
    assert names(network) == []


def test_ended_process_is_forgotten() -> None:
    """A process whose port is closed is gone, even if it was killed without a word."""
    network = Network()
    network.add(0)
    killed = network.add(1)
    network.count()
    network.run(LONG_S)
    del network.participants[killed.port]
    network.count()
    assert names(network) == ['node0_0']
    assert network.observer.is_complete


def test_restarted_process_replaces_the_old_one() -> None:
    """A new process at the port of an old one is asked, and the old one is forgotten."""
    network = Network()
    network.add(0, topics=['old'])
    network.count()
    network.run(LONG_S)
    network.add(0, topics=['new'])._answer_greeting()
    for _ in range(300):
        network.step()
    assert topics(network) == ['/in0', '/new']
    assert names(network) == ['node0_0']


def test_successor_of_a_killed_process_is_asked() -> None:
    """Who has taken the port of another that said no farewell is not mistaken for it."""
    network = Network()
    network.add(0, topics=['old'])
    network.count()
    network.run(LONG_S)
    network.add(0, topics=['new'])
    network.count()
    assert names(network) == []
    assert network.run(LONG_S) < 1.0
    assert topics(network) == ['/in0', '/new']


def test_everybody_is_taken_leave_of() -> None:
    """Those who have answered are told that we are gone."""
    network = Network()
    for index in range(3):
        network.add(index)
    network.count()
    network.run(LONG_S)
    network.observer.leave()
    assert sorted(network.farewells) == [7410, 7412, 7414]


def test_strangers_on_this_machine_are_ignored() -> None:
    """A participant that nobody counts is one of our own process."""
    network = Network()
    own = network.add(0)
    own._answer_greeting()
    network.step()
    assert network.observer.neighbours == []


@pytest.mark.parametrize('seed', range(20))
def test_damaged_datagrams_are_as_good_as_lost(seed: int) -> None:
    """Whatever arrives besides is not believed, and the graph is complete in the end."""
    network = Network()
    network.add(0, nodes=2, topics=['a', 'b'])
    network.count()
    noise = random.Random(seed)
    while not network.observer.is_complete and network.now_s < LONG_S:
        if network._socket:
            whole, _ = noise.choice(network._socket)
            network.observer.handle(whole[: noise.randrange(len(whole))], THIS_HOST)
            network.observer.handle(noise.randbytes(noise.randrange(200)), THIS_HOST)
        network.step()
    assert names(network) == ['node0_0', 'node0_1']
    assert topics(network) == ['/a', '/b', '/in0']


@pytest.mark.parametrize('seed', range(20))
def test_wrong_bytes_raise_nothing(seed: int) -> None:
    """Datagrams with other bytes than the sender meant are wrong, but no harm."""
    network = Network()
    network.add(0, nodes=2, topics=['a', 'b'])
    network.count()
    noise = random.Random(seed)
    for _ in range(400):
        for index, (datagram, host) in enumerate(network._socket):
            wrong = bytearray(datagram)
            wrong[noise.randrange(20, len(wrong))] = noise.randrange(256)
            network._socket[index] = bytes(wrong), host
        network.step()
    assert names(network) is not None


def hostile_samples(guid: bytes) -> list[bytes]:
    """Return descriptions that no participant sends."""
    named = struct.pack('<HH', PID_ENDPOINT_GUID, 16) + guid
    wrong = [
        struct.pack('<HH2s', kind, 2, b'ab') + struct.pack('<HH', PID_SENTINEL, 0)
        for kind in (PID_TOPIC_NAME, PID_RELIABILITY, PID_LIVELINESS, PID_USER_DATA)
    ]
    large = struct.pack('<HH', 0x8001, 0) * 15_000
    huge = struct.pack('<HHI', PID_TOPIC_NAME, 4, 2**32 - 1)
    return [b'\0\3\0\0' + named + rest for rest in (*wrong, large, huge)]


def test_hostile_descriptions_are_no_harm() -> None:
    """Parameters that are too short, too many or too long are not asked for again."""
    network = Network()
    participant = network.add(0, topics=['a'])
    network.count()
    network.run(LONG_S)
    for payload in hostile_samples(participant.prefix + b'\0\0\x77\x03'):
        participant._add(PUBLICATIONS_WRITER, payload)
    for _ in range(300):
        network.step()
    assert network.observer.is_complete
    assert topics(network) == ['/a', '/in0']


@pytest.mark.parametrize(
    'value', [b'abcd', struct.pack('<iI', 1, 70_000), struct.pack('<iI', 1, 0)]
)
def test_impossible_locators_are_nobody(value: bytes) -> None:
    """Who cannot be reached is not met."""
    network = Network()
    described = [(PID_METATRAFFIC_UNICAST_LOCATOR, value), (PID_DEFAULT_UNICAST_LOCATOR, value)]
    met = data(UNKNOWN_ENTITY, PARTICIPANTS_WRITER, 1, encode_parameters(described))
    network.observer.handle(message(b'x' * 12, met), '10.0.0.1')
    assert network.observer.neighbours == []


def test_huge_numbers_cost_nothing() -> None:
    """Whatever a writer says of its samples, what we keep in mind is bounded."""
    stream = Stream(PUBLICATIONS_READER, PUBLICATIONS_WRITER)
    for last in range(10**6, 10**9, 10**6):
        stream.on_heartbeat(1, last)
        stream.skip(2, last)
        stream.settle([last])
    assert not stream.is_complete
    assert len(stream._ahead) < 2 * MAX_AHEAD
    stream.skip(1, 10**9)
    assert stream.is_complete
    assert stream._ahead == set()
    assert len(acknack(stream.reader, stream.writer, *stream.request())) < 100


@pytest.mark.parametrize(('first', 'last'), [(0, 5), (-1, 5), (5, 3), (2**63 - 1, 2**63 - 1)])
def test_impossible_heartbeats(first: int, last: int) -> None:
    """Heartbeats that the specification calls invalid are errors (8.3.8.6.3)."""
    told = heartbeat(PUBLICATIONS_READER, PUBLICATIONS_WRITER, first, last, 1)
    with pytest.raises(ValueError, match='number|samples'):
        list(submessages(message(b'x' * 12, told), b'y' * 12))


def test_empty_time_is_not_the_end() -> None:
    """A submessage that may be empty does not reach to the end of the datagram."""
    told = heartbeat(PUBLICATIONS_READER, PUBLICATIONS_WRITER, 1, 5, 1)
    datagram = message(b'x' * 12, b'\x09\x03\0\0', b'\x01\x01\0\0', told)
    expected = [Heartbeat(PUBLICATIONS_READER, PUBLICATIONS_WRITER, 1, 5)]
    assert list(submessages(datagram, b'y' * 12)) == expected


def test_destinations_and_byte_orders() -> None:
    """What is for somebody else is skipped; big-endian submessages are read as well."""
    own, other = bytes(range(12)), bytes(range(1, 13))
    reader, writer = b'\0\0\3\xc7', b'\0\0\3\xc2'
    told = heartbeat(reader, writer, 1, 5, 1)
    for_other = b'\x0e\x01\x0c\x00' + other
    for_us = b'\x0e\x01\x0c\x00' + own
    datagram = message(other, for_other, told, for_us, told, gap(reader, writer, 3))
    expected = [Heartbeat(reader, writer, 1, 5), Gap(reader, writer, 3, 4, frozenset())]
    assert list(submessages(datagram, own)) == expected
    big = b'\x07\x00\x00\x1c' + reader + writer + bytes.fromhex('00000000 00000001')
    big += bytes.fromhex('00000000 00000005 00000001')
    assert list(submessages(message(other, big), own)) == expected[:1]


def test_request_names_what_is_missing() -> None:
    """The bits of a request are counted from its base, the most significant one first."""
    request = acknack(b'rrrr', b'wwww', 3, [3, 4, 36], 9)
    size, *words = struct.unpack_from('<III', request, 20)
    assert request[12:20] == b'\0\0\0\0\3\0\0\0'
    assert size == 34
    assert words == [0b11 << 30, 0b01 << 30]


@pytest.mark.parametrize('payload', [b'', b'\0\1\0\0', b'\0\1\0\0' + b'\xff' * 30])
def test_damaged_payloads(payload: bytes) -> None:
    """Payloads that end too early are errors, not endless loops."""
    with pytest.raises(ValueError, match='damaged|missing'):
        decode_entities(payload)
    with pytest.raises(ValueError, match='damaged'):
        decode_parameters(payload)


@pytest.mark.parametrize(
    ('raw', 'expected'),
    [
        (b'/robot1/arm\0', '/robot1/arm'),
        ('/gr\u00fcn\0'.encode(), '/gr\u00fcn'),
        (b'/a\x1b[2J\nb\0', r'/a\x1b[2J\nb'),
        (b'/\xff\xfe\0', r'/\xff\xfe'),
        ('/\u202ea'.encode(), r'/\u202ea'),
        (b'/a\0b\0', r'/a\x00b'),
    ],
)
def test_names_do_nothing_to_a_terminal(raw: bytes, expected: str) -> None:
    """Whoever sends a name, printing it neither begins a line nor moves a cursor."""
    assert text_of(raw) == expected


def test_ports() -> None:
    """The ports are those of the specification."""
    assert unicast_ports(0)[0] == 7410
    assert unicast_ports(42)[3] == 7400 + 250 * 42 + 10 + 6
