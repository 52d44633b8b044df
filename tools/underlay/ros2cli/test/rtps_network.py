# SPDX-License-Identifier: Apache-2.0
"""A network in memory with participants that answer as those of Fast DDS do."""

from collections.abc import Callable, Iterable, Iterator
import heapq
import itertools
import random
import struct

from ros2cli.graph.graph import Graph
from ros2cli.rtps.entities import TOPIC, TYPE_NAME
from ros2cli.rtps.identifiers import (
    ENTITIES_READER,
    MULTICAST_ADDRESS,
    PARTICIPANTS_WRITER,
    PID_DEFAULT_UNICAST_LOCATOR,
    PID_DURABILITY,
    PID_ENDPOINT_GUID,
    PID_KEY_HASH,
    PID_LEASE_DURATION,
    PID_METATRAFFIC_UNICAST_LOCATOR,
    PID_RELIABILITY,
    PID_STATUS_INFO,
    PID_TOPIC_NAME,
    PID_TYPE_NAME,
    PID_USER_DATA,
    PUBLICATIONS_READER,
    PUBLICATIONS_WRITER,
    SUBSCRIPTIONS_READER,
    SUBSCRIPTIONS_WRITER,
    UNKNOWN_ENTITY,
)
from ros2cli.rtps.message import data, heartbeat, message
from ros2cli.rtps.observer import Observer
from ros2cli.rtps.parameters import (
    Address,
    duration_value,
    encode_inline,
    encode_parameters,
    locator_value,
    number_value,
    text_value,
    THIS_HOST,
)

OBSERVER: Address = (THIS_HOST, 50000)
ENTITIES_WRITER = bytes.fromhex('00000103')
HEADER_BYTES = 20
ACKNACK, INFO_DESTINATION, DATA = 0x06, 0x0E, 0x15
FRAGMENT_BYTES = 32000
ANSWER_S = 0.1
DISTANT_HOST = '10.0.0.2'
HASH = 'RIHS01_' + 'ab' * 32


class Network:
    """Carries datagrams in virtual time; the observer's socket holds a limited number of them."""

    def __init__(self, *, loss: float = 0.0, room: int = 200, seed: int = 0) -> None:
        """Begin without participants."""
        self.now_s = 0.0
        self.dropped = 0
        self.farewells: list[int] = []
        self.participants: dict[int, Participant] = {}
        self.observer = Observer([OBSERVER], self._to_participant)
        self._random = random.Random(seed)
        self._loss = loss
        self._room = room
        self._events: list[tuple[float, int, Callable[[], None]]] = []
        self._order = itertools.count()
        self._socket: list[tuple[bytes, str]] = []

    def add(
        self, index: int, nodes: int = 1, topics: Iterable[str] = (), host: str = THIS_HOST
    ) -> 'Participant':
        """Start a process."""
        participant = Participant(self, index, nodes, list(topics), host)
        self.participants[participant.port] = participant
        return participant

    def count(self) -> None:
        """Tell the observer which ports are open."""
        here = [each for each in self.participants.values() if each.host == THIS_HOST]
        self.observer.expect({(THIS_HOST, each.port): each.prefix.hex() for each in here})

    def run(self, duration_s: float) -> float:
        """Let time pass until the observer knows all; return the time."""
        end_s = self.now_s + duration_s
        while self.now_s < end_s and not self.observer.is_complete:
            self.step()
        return self.now_s

    def step(self) -> None:
        """Let a millisecond pass, in which ten datagrams can be read."""
        self.observer.ask(self.now_s)
        self.now_s += 0.001
        while self._events and self._events[0][0] <= self.now_s:
            heapq.heappop(self._events)[2]()
        for _ in range(min(10, len(self._socket))):
            self.observer.handle(*self._socket.pop(0))

    def later(self, delay_s: float, event: Callable[[], None]) -> None:
        """Do something after some time."""
        heapq.heappush(self._events, (self.now_s + delay_s, next(self._order), event))

    def to_observer(self, datagram: bytes, host: str) -> None:
        """Deliver a datagram twice, as Fast DDS does, or lose it."""
        for _ in range(2):
            if len(self._socket) >= self._room or self._random.random() < self._loss:
                self.dropped += 1
            else:
                self._socket.append((datagram, host))

    @property
    def graph(self) -> Graph:
        """Return what the observer knows."""
        neighbours = self.observer.neighbours
        return Graph(
            (node for each in neighbours for node in each.nodes),
            (end for each in neighbours for end in each.endpoints.values()),
        )

    def _to_participant(self, datagram: bytes, address: Address) -> None:
        host, port = address
        if host == MULTICAST_ADDRESS:
            for each in self.participants.values():
                each.receive(datagram, is_multicast=True)
        participant = self.participants.get(port & ~1)
        if participant and self._random.random() >= self._loss:
            participant.receive(datagram)


class Participant:
    """A process with nodes, each of which publishes topics and subscribes to one."""

    def __init__(
        self, network: Network, index: int, nodes: int, topics: list[str], host: str
    ) -> None:
        """Make the endpoints."""
        self.host = host
        self.port = 7410 + 2 * index
        self.prefix = struct.pack('>HHII', 0x010F, 7, index, network._random.randrange(2**32))
        self._network = network
        self._samples: dict[bytes, dict[int, list[bytes]]] = {
            PUBLICATIONS_WRITER: {},
            SUBSCRIPTIONS_WRITER: {},
            ENTITIES_WRITER: {},
        }
        self._last = dict.fromkeys(self._samples, 0)
        self._is_known = self._knows_reader = False
        self._wanted: dict[bytes, set[int]] = {}
        self._nodes: list[tuple[str, list[bytes], list[bytes]]] = []
        self.publish(TOPIC, TYPE_NAME)
        for node in range(nodes):
            writers = [self.publish(f'rt/{topic}') for topic in topics]
            readers = [self.subscribe(f'rt/in{index}')]
            self._nodes.append((f'node{index}_{node}', readers, writers))
            self._tell_entities()

    def publish(self, topic: str, type_name: str = 'std_msgs::msg::dds_::String_') -> bytes:
        """Create a publisher; return its identity."""
        return self._create(PUBLICATIONS_WRITER, topic, type_name, 0x03)

    def subscribe(self, topic: str) -> bytes:
        """Create a subscription; return its identity."""
        return self._create(SUBSCRIPTIONS_WRITER, topic, 'std_msgs::msg::dds_::String_', 0x04)

    def destroy(self, guid: bytes) -> None:
        """End a publisher: its sample is replaced by the news that it is no more."""
        samples = self._samples[PUBLICATIONS_WRITER]
        gone = [number for number, parts in samples.items() if guid in parts[0]]
        for number in gone:
            del samples[number]
        self._add(PUBLICATIONS_WRITER, encode_parameters([(PID_ENDPOINT_GUID, guid)]), guid)

    def receive(self, datagram: bytes, *, is_multicast: bool = False) -> None:
        """Answer a greeting at once, and requests after a while, unless they are for another."""
        offset, is_for_us = HEADER_BYTES, True
        while offset < len(datagram):
            kind, _, size = struct.unpack_from('<BBH', datagram, offset)
            start, offset = offset + 4, offset + 4 + size
            body = datagram[start:offset]
            if kind == INFO_DESTINATION:
                is_for_us = body == self.prefix
            elif not is_for_us:
                continue
            elif kind == DATA and body[8:12] == PARTICIPANTS_WRITER:
                if PID_STATUS_INFO.to_bytes(2, 'little') + b'\x04\x00\0\0\0\3' in body:
                    self._network.farewells.append(self.port)
                else:
                    self._answer_greeting(knows_reader=not is_multicast)
            elif kind == ACKNACK:
                self._answer_request(body)

    def _answer_greeting(self, *, knows_reader: bool = True) -> None:
        self._knows_reader |= knows_reader
        locators = (PID_METATRAFFIC_UNICAST_LOCATOR, 0), (PID_DEFAULT_UNICAST_LOCATOR, 1)
        described = encode_parameters(
            [
                (PID_LEASE_DURATION, duration_value(20)),
                *((kind, locator_value((THIS_HOST, self.port + add))) for kind, add in locators),
            ]
        )
        self._send(data(UNKNOWN_ENTITY, PARTICIPANTS_WRITER, 1, described))
        self._is_known = True
        for writer in self._samples:
            if self._knows_reader or writer != ENTITIES_WRITER:
                self._tell(writer)

    def _answer_request(self, body: bytes) -> None:
        writer = body[4:8]
        base, size = struct.unpack_from('<II', body, 12)
        words = struct.unpack_from(f'<{(size + 31) // 32}I', body, 20)
        wanted = {base + i for i in range(size) if words[i // 32] & 1 << (31 - i % 32)}
        if wanted and (self._knows_reader or writer != ENTITIES_WRITER):
            self._wanted.setdefault(writer, set()).update(wanted)
            self._network.later(ANSWER_S, lambda: self._send_wanted(writer))

    def _send_wanted(self, writer: bytes) -> None:
        for number in sorted(self._wanted.pop(writer, set())):
            if number in self._samples[writer]:
                self._send_sample(writer, number)
            else:
                self._send(gap(_reader(writer), writer, number))

    def _tell(self, writer: bytes) -> None:
        numbers = self._samples[writer]
        first = min(numbers, default=1)
        self._send(heartbeat(_reader(writer), writer, first, self._last[writer], 1))

    def _create(self, writer: bytes, topic: str, type_name: str, kind: int) -> bytes:
        number = self._last[writer] + 1
        entity = ENTITIES_WRITER if topic == TOPIC else struct.pack('>xHB', number + 1, kind)
        guid = self.prefix + entity
        self._add(
            writer,
            encode_parameters(
                [
                    (PID_ENDPOINT_GUID, guid),
                    (PID_TOPIC_NAME, text_value(topic)),
                    (PID_TYPE_NAME, text_value(type_name)),
                    (PID_RELIABILITY, number_value(2) + duration_value(0)),
                    (PID_DURABILITY, number_value(1)),
                    (PID_USER_DATA, text_value(f'typehash={HASH};')),
                ]
            ),
        )
        return guid

    def _add(self, writer: bytes, payload: bytes, gone: bytes = b'') -> None:
        qos = encode_inline([(PID_KEY_HASH, gone), (PID_STATUS_INFO, b'\0\0\0\3')])
        self._last[writer] += 1
        number = self._last[writer]
        if len(payload) > FRAGMENT_BYTES:
            parts = list(fragments(_reader(writer), writer, number, payload))
        else:
            ends = _reader(writer), writer, number
            parts = [data(*ends, payload, qos, is_key=True) if gone else data(*ends, payload)]
        self._samples[writer][number] = parts
        if self._is_known:
            self._send_sample(writer, number)

    def _send_sample(self, writer: bytes, number: int) -> None:
        for part in self._samples[writer][number]:
            self._send(part)
        self._tell(writer)

    def _tell_entities(self) -> None:
        payload = b'\0\1\0\0' + bytes(16) + struct.pack('<I', len(self._nodes))
        for name, readers, writers in self._nodes:
            for text in ('/', name):
                payload += bytes(-len(payload) % 4) + text_value(text)
            for guids in (readers, writers):
                payload += bytes(-len(payload) % 4) + struct.pack('<I', len(guids))
                payload += b''.join(guids)
        self._samples[ENTITIES_WRITER].clear()  # it keeps only its last
        self._add(ENTITIES_WRITER, payload)

    def _send(self, *parts: bytes) -> None:
        self._network.to_observer(message(self.prefix, *parts), self.host)


def gap(reader: bytes, writer: bytes, number: int) -> bytes:
    """Return the submessage by which a writer tells that it no longer has a sample."""
    body = reader + writer + struct.pack('<iIiII', 0, number, 0, number + 1, 0)
    return struct.pack('<BBH', 0x08, 1, len(body)) + body


def fragments(reader: bytes, writer: bytes, number: int, payload: bytes) -> Iterator[bytes]:
    """Yield the submessages that carry a large sample, a part each."""
    for index in range(0, len(payload), FRAGMENT_BYTES):
        first = index // FRAGMENT_BYTES + 1
        body = struct.pack('<HH', 0, 28) + reader + writer + struct.pack('<iI', 0, number)
        body += struct.pack('<IHHI', first, 1, FRAGMENT_BYTES, len(payload))
        body += payload[index:][:FRAGMENT_BYTES]
        yield struct.pack('<BBH', 0x16, 1, len(body)) + body


def _reader(writer: bytes) -> bytes:
    return {
        PUBLICATIONS_WRITER: PUBLICATIONS_READER,
        SUBSCRIPTIONS_WRITER: SUBSCRIPTIONS_READER,
        ENTITIES_WRITER: ENTITIES_READER,
    }[writer]
