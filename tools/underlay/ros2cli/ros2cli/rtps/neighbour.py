# SPDX-License-Identifier: Apache-2.0
"""Discovery state of another participant: its endpoints and nodes, and what to request."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ros2cli.rtps.entities import (
    decode_entities,
    Endpoint,
    endpoint_of,
    guid_of,
    NodeEntities,
    TOPIC,
)
from ros2cli.rtps.identifiers import (
    ENTITIES_READER,
    PREFIX_BYTES,
    PUBLICATIONS_READER,
    PUBLICATIONS_WRITER,
    SUBSCRIPTIONS_READER,
    SUBSCRIPTIONS_WRITER,
)
from ros2cli.rtps.message import (
    acknack,
    Data,
    Fragment,
    Gap,
    Heartbeat,
    info_destination,
    message,
    Submessage,
)
from ros2cli.rtps.parameters import Address, decode_parameters, Parameters, THIS_HOST
from ros2cli.rtps.stream import Stream

PATIENCE_S = 0.13  # longer than the 0.1 s that Fast DDS takes to answer a request
MAX_PATIENCE_S = 0.5
NO_QOS = Parameters({}, '<')


class Neighbour:
    """
    Another participant; builds and parses datagrams, but neither sends nor receives any.

    Parameters
    ----------
    own_prefix
        Our GUID prefix (12 bytes).
    prefix
        The participant's GUID prefix (12 bytes).
    discovery
        Its address for participant and endpoint discovery.
    user
        Its address for user traffic.
    built_in
        The streams of its discovery: its readers and writers, unless a server describes them.

    Attributes
    ----------
    heard_s
        When it was last heard, in s of the observer's clock.
    lease_s
        Its lease duration, after which it counts as lost, in s.
    endpoints
        The readers and writers that it has described, by GUID.
    nodes
        The nodes that it has described.

    """

    def __init__(
        self,
        own_prefix: bytes,
        prefix: bytes,
        discovery: Address,
        user: Address,
        built_in: Sequence[Stream],
    ) -> None:
        self.prefix = prefix
        self.discovery = discovery
        self.heard_s = 0.0
        self.lease_s = float('inf')
        self.endpoints: dict[bytes, Endpoint] = {}
        self.nodes: tuple[NodeEntities, ...] = ()
        self._own_prefix = own_prefix
        self._user = user
        self._built_in = built_in
        self._entities: Stream | None = None
        self._latest_entities = 0
        self._patience_s = PATIENCE_S
        self._ask_again_s = 0.0
        self._is_acknowledged = False

    @property
    def is_here(self) -> bool:
        """Whether it is on this machine."""
        return self.discovery[0] == THIS_HOST

    @property
    def is_complete(self) -> bool:
        """Whether all its endpoints and nodes are known."""
        return all(stream.is_complete for stream in self._streams())

    @property
    def knows_reader(self) -> bool:
        """Whether it has matched our reader of nodes, or has no writer for it yet."""
        return self._entities is None or self._entities.is_announced

    @property
    def due_s(self) -> float:
        """The time of the next request."""
        return float('inf') if self._is_acknowledged else self._ask_again_s

    def handle(self, news: Submessage) -> None:
        """
        Handle a submessage from this participant.

        Parameters
        ----------
        news
            The submessage.

        Raises
        ------
        ValueError
            The sample in it is damaged.

        """
        stream = self._stream(news)
        if stream is None:
            return
        if isinstance(news, Heartbeat):
            if stream.on_heartbeat(news.first, news.last):
                self._ask_again_s = 0.0
                self._is_acknowledged = False
        elif isinstance(news, Gap):
            stream.skip(news.start, news.end)
            stream.settle(news.numbers)
        elif stream.wants(news.number):
            sample = _reassembled(stream, news) if isinstance(news, Fragment) else news
            if sample:
                self._on_sample(stream, sample)
        self._hurry()

    def requests(self, now_s: float) -> Iterator[tuple[bytes, Address]]:
        """
        Build the datagrams that request what is missing.

        The interval between requests grows; a complete state is acknowledged.

        Parameters
        ----------
        now_s
            The current time, in s of the observer's clock.

        Yields
        ------
        tuple of bytes and Address
            A datagram, and where to send it.

        """
        self._is_acknowledged = self.is_complete
        self._ask_again_s = now_s + self._patience_s
        self._patience_s = min(2 * self._patience_s, MAX_PATIENCE_S)
        if self._built_in:
            yield self._message(*map(_request, self._built_in)), self.discovery
        if self._entities:
            yield self._message(_request(self._entities)), self._user

    def ask_again(self) -> None:
        """Ask for its nodes once more, to see whether it still answers."""
        if self._entities:
            self._entities.want_last()
            self._ask_again_s = 0.0
            self._is_acknowledged = False
            self._patience_s = PATIENCE_S

    def add(self, endpoint: Endpoint) -> None:
        """
        Add one of its readers and writers.

        Parameters
        ----------
        endpoint
            The endpoint.

        """
        self.endpoints[endpoint.guid] = endpoint
        if endpoint.is_writer and endpoint.topic == TOPIC and not self._entities:
            self._entities = Stream(ENTITIES_READER, endpoint.guid[PREFIX_BYTES:])

    def found_at(self, host: str) -> None:
        """
        Set the host that its datagrams come from, as it may have announced several addresses.

        Parameters
        ----------
        host
            The IP address; THIS_HOST if it is on this machine.

        """
        self.discovery = (host, self.discovery[1])
        self._user = (host, self._user[1])

    def on_described(self, sample: Data) -> None:
        """
        Handle the description of a reader or writer, or its end.

        Parameters
        ----------
        sample
            The sample of a built-in writer.

        Raises
        ------
        ValueError
            The sample is damaged.

        """
        if sample.is_disposed:
            described = decode_parameters(sample.payload) if sample.payload else sample.inline
            self.endpoints.pop(guid_of(described), None)
        else:
            is_writer = sample.writer == PUBLICATIONS_WRITER
            self.add(endpoint_of(decode_parameters(sample.payload), is_writer=is_writer))

    def _on_sample(self, stream: Stream, sample: Data) -> None:
        """Handle a sample; a damaged one is not requested again."""
        stream.settle([sample.number])
        if stream is self._entities:
            self._on_nodes(sample)
        else:
            self.on_described(sample)

    def _hurry(self) -> None:
        """Make the next request due as soon as the previous one is answered."""
        if self.is_complete:
            if not self._is_acknowledged:
                self._ask_again_s = 0.0
        elif all(each.is_complete or each.is_answered for each in self._streams()):
            self._ask_again_s = 0.0
            self._patience_s = PATIENCE_S

    def _streams(self) -> list[Stream]:
        return [*self._built_in, *([self._entities] if self._entities else [])]

    def _message(self, *parts: bytes) -> bytes:
        return message(self._own_prefix, info_destination(self.prefix), *parts)

    def _stream(self, news: Submessage) -> Stream | None:
        if news.reader == ENTITIES_READER and not self._entities:
            self._entities = Stream(ENTITIES_READER, news.writer)
        return next((each for each in self._streams() if each.writer == news.writer), None)

    def _on_nodes(self, news: Data) -> None:
        if news.number > self._latest_entities:
            self._latest_entities = news.number
            self.nodes = decode_entities(news.payload)


def endpoint_streams() -> list[Stream]:
    """Return the streams by which a participant describes its readers and writers."""
    return [
        Stream(PUBLICATIONS_READER, PUBLICATIONS_WRITER),
        Stream(SUBSCRIPTIONS_READER, SUBSCRIPTIONS_WRITER),
    ]


def _request(stream: Stream) -> bytes:
    """Build the submessage that acknowledges the samples of a stream and requests missing ones."""
    return acknack(stream.reader, stream.writer, *stream.request())


def _reassembled(stream: Stream, news: Fragment) -> Data | None:
    """Return the whole sample if this was its last missing fragment."""
    payload = stream.fragments.add(news.number, news.size, news.start, news.payload)
    if payload is None:
        return None
    return Data(news.reader, news.writer, news.number, payload, NO_QOS, False)
