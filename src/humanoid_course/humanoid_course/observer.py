# SPDX-License-Identifier: Apache-2.0
"""A node that watches the nodes of a student: their topics, messages and parameters."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from importlib import import_module
import os
import socket
import time
from typing import Any

from domain_coordinator import domain_id
from humanoid_common.executing import destroy, make_executor
from humanoid_course.observations import Endpoint
import rclpy
from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

_NAME = 'humanoid_course_observer'
_HIDDEN = ('/rosout', '/parameter_events')
_UNKNOWN = '_NODE_NAME_UNKNOWN_'  # of a node whose name has not arrived yet
_MOST_VALUES = 200
_SLICE_S = 0.02
_ANSWER_TIMEOUT_S = 3.0
_REPEAT_S = 1.0
"""A request is repeated so often: a server that does not know the client yet cannot answer."""
_NUMBER_FIELDS = ('temperature', 'data')
_NUMBER_TYPES = ('double', 'float', *(f'{u}int{n}' for u in ('', 'u') for n in (8, 16, 32, 64)))
_EVERYTHING = QoSProfile(
    depth=_MOST_VALUES,
    reliability=ReliabilityPolicy.BEST_EFFORT,
    durability=DurabilityPolicy.VOLATILE,
)
_LATCHED = QoSProfile(
    depth=1,
    reliability=ReliabilityPolicy.RELIABLE,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
)


@dataclass
class Graph:
    """The nodes and topics that are there now, without those of the observer."""

    nodes: tuple[str, ...] = ()
    publishers: dict[str, tuple[Endpoint, ...]] = field(default_factory=dict)
    subscriptions: dict[str, tuple[Endpoint, ...]] = field(default_factory=dict)


class Observer:
    """
    Observer in the domain that `free_domain` has chosen for this process.

    Attributes
    ----------
    values
        Numbers or texts received, by topic.
    counts
        Messages received, by topic.

    """

    def __init__(self) -> None:
        self._context = Context()
        rclpy.init(args=[], context=self._context)
        self._executor = make_executor(self._context)
        self._node = Node(
            _NAME, context=self._context, enable_rosout=False, start_parameter_services=False
        )
        self._executor.add_node(self._node)
        self.values: dict[str, list[float | str]] = {}
        self.counts: dict[str, int] = {}

    def spin(self, duration_s: float, is_over: Callable[[], bool] = lambda: False) -> None:
        """
        Handle events for some time.

        Parameters
        ----------
        duration_s
            How long.
        is_over
            Ends it earlier.

        """
        end_s = time.monotonic() + duration_s
        while not is_over() and time.monotonic() < end_s:
            self._executor.spin_once(timeout_sec=_SLICE_S)

    def graph(self) -> Graph:
        """Look at the graph, and subscribe to topics that are new."""
        seen = Graph()
        nodes = self._node.get_node_names_and_namespaces()
        seen.nodes = tuple(
            sorted(_full_name(*each) for each in nodes if each[0] not in (_NAME, _UNKNOWN))
        )
        for topic, kinds in sorted(self._node.get_topic_names_and_types()):
            if topic in _HIDDEN:
                continue
            publishers = _endpoints(self._node.get_publishers_info_by_topic(topic))
            subscriptions = _endpoints(self._node.get_subscriptions_info_by_topic(topic))
            if publishers:
                seen.publishers[topic] = publishers
                self._subscribe(topic, kinds[0])
            if subscriptions:
                seen.subscriptions[topic] = subscriptions
        return seen

    def _subscribe(self, topic: str, kind: str) -> None:
        """Count the messages of a topic; those of a type that is not installed are not seen."""
        if topic in self.counts:
            return
        self.counts[topic] = 0
        values = self.values.setdefault(topic, [])
        message = _message_class(kind)
        if message is None:
            return
        name = _number_field(message)

        def receive(received: Any) -> None:
            self.counts[topic] += 1
            value = getattr(received, name) if name else getattr(received, 'data', None)
            if isinstance(value, (int, float, str)) and len(values) < _MOST_VALUES:
                values.append(value)

        profile = _LATCHED if topic.endswith('robot_description') else _EVERYTHING
        self._node.create_subscription(message, topic, receive, profile)

    def send(self, topic: str, kind: str, values: list[float], period_s: float) -> None:
        """
        Publish readings, one after another, once somebody receives them.

        Parameters
        ----------
        topic, kind
            The topic, and its type, which has a number.
        values
            The readings.
        period_s
            The time after each of them.

        """
        message = _message_class(kind)
        name = _number_field(message)
        publisher = next(
            (each for each in self._node.publishers if each.topic_name == topic), None
        ) or self._node.create_publisher(message, topic, _LATCHED)
        self.spin(_ANSWER_TIMEOUT_S, lambda: publisher.get_subscription_count() > 0)
        for value in values:
            field_type = message.get_fields_and_field_types()[name]
            is_float = field_type in ('double', 'float')
            publisher.publish(message(**{name: float(value) if is_float else round(value)}))
            self.spin(period_s)

    def parameters(self, nodes: tuple[str, ...]) -> tuple[dict[str, str], bool]:
        """
        Read the parameters of nodes that are texts.

        Parameters
        ----------
        nodes
            Their full names.

        Returns
        -------
        tuple of dict and bool
            The text of each, by `NAME of NODE`; whether all nodes that have the services answered.

        """
        found: dict[str, str] = {}
        are_complete = True
        for node in dict.fromkeys(nodes):
            existing = set(self._node.clients)
            client = AsyncParameterClient(self._node, node)
            try:
                self.spin(_ANSWER_TIMEOUT_S, client.services_are_ready)
                if client.services_are_ready():
                    are_complete &= self._read_texts(client, node, found)
            finally:
                for each in set(self._node.clients) - existing:
                    self._node.destroy_client(each)
        return found, are_complete

    def _read_texts(self, client: AsyncParameterClient, node: str, found: dict[str, str]) -> bool:
        """Add the parameters of a node that are texts; return whether it answered."""
        listed = self._answer(lambda: client.list_parameters([], 10))
        names = list(listed.result.names) if listed else []
        values = self._answer(lambda: client.get_parameters(names)) if names else None
        for name, value in zip(names, values.values if values else ()):
            if value.type == Parameter.Type.STRING.value:
                found[f'{name} of {node}'] = value.string_value
        return bool(listed) and (not names or bool(values))

    def _answer(self, request: Callable[[], Any]) -> Any:
        """Repeat a request until one is answered; None if none is."""
        futures: list[Any] = []
        end_s = time.monotonic() + _ANSWER_TIMEOUT_S
        while time.monotonic() < end_s:
            futures.append(request())
            self.spin(_REPEAT_S, lambda: any(each.done() for each in futures))
            for each in futures:
                if each.done():
                    return each.result()
        return None

    def close(self) -> None:
        """Leave the domain."""
        self._executor.shutdown()
        destroy(self._node)
        self._context.try_shutdown()


def number_field_of(kind: str) -> str:
    """
    Find the field of a type that holds its number; '' if there is none or it is not installed.

    Parameters
    ----------
    kind
        The type, such as `std_msgs/msg/Float32`.

    """
    message = _message_class(kind)
    return '' if message is None else _number_field(message)


def _message_class(kind: str) -> Any:
    """Import the class of a type; None if it is not installed."""
    package, _, name = kind.partition('/msg/')
    if not name:
        return None
    try:
        return getattr(import_module(f'{package}.msg'), name)
    except (AttributeError, ImportError, ValueError):
        return None


def _number_field(message: Any) -> str:
    """Find the field of a message that holds its number; '' if there is none."""
    fields: Mapping[str, str] = message.get_fields_and_field_types()
    return next((name for name in _NUMBER_FIELDS if fields.get(name) in _NUMBER_TYPES), '')


def _full_name(name: str, namespace: str) -> str:
    return f'{namespace.rstrip("/")}/{name}'


def _endpoints(infos: Any) -> tuple[Endpoint, ...]:
    return tuple(
        Endpoint(_full_name(each.node_name, each.node_namespace), each.topic_type)
        for each in infos
        if each.node_name not in (_NAME, _UNKNOWN)
    )


@contextmanager
def free_domain() -> Iterator[int]:
    """
    Put this process and its programs into a domain that nobody uses, on this machine only.

    Yields
    ------
    int
        The domain.

    """
    used = ('ROS_LOCALHOST_ONLY', 'ROS_STATIC_PEERS', 'ROS_DISCOVERY_SERVER', 'ROS_NAMESPACE')
    with domain_id(_next_unused()) as domain:
        for name in used:
            os.environ.pop(name, None)
        os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
        os.environ['ROS_DOMAIN_ID'] = str(domain)
        yield domain


def _next_unused() -> Callable[[], int]:
    """Return a function that returns domains 1 to 100 in which no robot runs here."""
    domains = (1 + (os.getpid() + step) % 100 for step in range(1000))

    return lambda: next(each for each in domains if not _is_used(each))


def _is_used(domain: int) -> bool:
    """Whether a participant of the domain has its ports, by the formula of the DDS standard."""
    for port in (7400, 7410, 7412, 7414):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            try:
                probe.bind(('', port + 250 * domain))
            except OSError:
                return True
    return False
