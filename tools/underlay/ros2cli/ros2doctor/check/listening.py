# SPDX-License-Identifier: Apache-2.0
"""Listen to what running nodes tell: transforms, diagnostics, and whether they use /clock."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from importlib import import_module
import time
from typing import Any, NamedTuple

TRANSFORM_TYPE = 'tf2_msgs/msg/TFMessage'
STATIC_SUFFIX = '_static'
DEPTH = 100
DIAGNOSTICS_TYPE = 'diagnostic_msgs/msg/DiagnosticArray'
WARN = 1
CLOCK_TOPIC = '/clock'
SIM_TIME_PARAMETER = 'use_sim_time'
ANSWER_TIME_S = 1.0
MOST_NODES = 50
PERIOD_S = 0.05


class Transform(NamedTuple):
    """
    An edge in a tree of frames.

    :param tree: the topic of moving transforms, to which the static ones of its name belong
    """

    tree: str
    parent: str
    child: str


class TransformListener:
    """
    Listener that collects the transforms of all transform topics.

    Parameters
    ----------
    node
        The `DirectNode` that subscribes, once `listen_to` has been called.

    Attributes
    ----------
    transforms
        The edges received so far.

    """

    def __init__(self, node: Any) -> None:
        self.transforms: set[Transform] = set()
        self._node = node
        self._subscriptions: list[Any] = []

    @property
    def is_listening(self) -> bool:
        """Whether there is any topic to listen to."""
        return bool(self._subscriptions)

    def listen_to(self, types: Mapping[str, str]) -> None:
        """
        Subscribe to the topics that carry transforms, if tf2_msgs is installed.

        Parameters
        ----------
        types
            The name of the type of each topic, such as `tf2_msgs/msg/TFMessage`.

        """
        topics = [topic for topic, name in types.items() if name == TRANSFORM_TYPE]
        if not topics:
            return
        try:
            message_type = import_module('tf2_msgs.msg').TFMessage
        except ImportError:
            return
        self._subscriptions = [self._subscribe(message_type, topic) for topic in topics]

    def _subscribe(self, message_type: Any, topic: str) -> Any:
        from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

        is_static = topic.endswith(STATIC_SUFFIX)
        profile = QoSProfile(
            depth=DEPTH,
            reliability=ReliabilityPolicy.RELIABLE if is_static else ReliabilityPolicy.BEST_EFFORT,
            durability=DurabilityPolicy.TRANSIENT_LOCAL
            if is_static
            else DurabilityPolicy.VOLATILE,
        )
        tree = topic.removesuffix(STATIC_SUFFIX)

        def receive(message: Any) -> None:
            for each in message.transforms:
                edge = Transform(tree, each.header.frame_id, each.child_frame_id)
                self.transforms.add(edge)

        return self._node.create_subscription(message_type, topic, receive, profile)


class Complaint(NamedTuple):
    """
    A diagnostic status that is not OK.

    :param level: 1 is a warning, more is worse
    """

    name: str
    level: int
    message: str


class DiagnosticsListener:
    """
    Listener that stores the newest diagnostic status of each component of a robot.

    Parameters
    ----------
    node
        The `DirectNode` that subscribes, once `listen_to` has been called.

    """

    def __init__(self, node: Any) -> None:
        self._node = node
        self._newest: dict[str, Complaint] = {}
        self._subscriptions: list[Any] = []

    @property
    def is_listening(self) -> bool:
        """Whether there is any topic to listen to."""
        return bool(self._subscriptions)

    @property
    def complaints(self) -> list[Complaint]:
        """Return the statuses that are not OK."""
        return sorted(each for each in self._newest.values() if each.level >= WARN)

    def listen_to(self, types: Mapping[str, str]) -> None:
        """
        Subscribe to the topics that carry diagnostics, if diagnostic_msgs is installed.

        Parameters
        ----------
        types
            The name of the type of each topic, such as `std_msgs/msg/String`.

        """
        topics = [topic for topic, name in types.items() if name == DIAGNOSTICS_TYPE]
        if not topics:
            return
        try:
            message_type = import_module('diagnostic_msgs.msg').DiagnosticArray
        except ImportError:
            return
        from rclpy.qos import QoSProfile, ReliabilityPolicy

        profile = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
        self._subscriptions = [
            self._node.create_subscription(message_type, topic, self.take, profile)
            for topic in topics
        ]

    def take(self, message: Any) -> None:
        """
        Store the status of each component in a message, replacing its last one.

        Parameters
        ----------
        message
            A diagnostic_msgs/msg/DiagnosticArray.

        """
        for status in message.status:
            level = int.from_bytes(status.level, 'little')
            self._newest[status.name] = Complaint(status.name, level, status.message)


def nodes_on_clock(node: Any, candidates: Iterable[str]) -> tuple[str, ...]:
    """
    Find the nodes whose parameter use_sim_time is true, by their parameter services.

    All are queried at the same time, which takes a second at most; those that have not answered by
    then are left out.

    Parameters
    ----------
    node
        The `DirectNode` that calls the services.
    candidates
        Full names of the nodes to query; only the first 50 by name are.

    Returns
    -------
    tuple of str
        Their full names, sorted.

    """
    from rcl_interfaces.srv import GetParameters

    names = sorted(set(candidates))[:MOST_NODES]
    clients = {name: node.create_client(GetParameters, f'{name}/get_parameters') for name in names}
    answers: dict[str, Any] = {}
    end = time.monotonic() + ANSWER_TIME_S
    try:
        while not _all_done(answers, names) and time.monotonic() < end:
            for name, client in clients.items():
                if name not in answers and client.service_is_ready():
                    request = GetParameters.Request(names=[SIM_TIME_PARAMETER])
                    answers[name] = client.call_async(request)
            node.spin_once(PERIOD_S)
        return tuple(name for name in names if _is_true(answers.get(name)))
    finally:
        for client in clients.values():
            node.destroy_client(client)


def _all_done(answers: dict[str, Any], names: list[str]) -> bool:
    return len(answers) == len(names) and all(each.done() for each in answers.values())


def _is_true(answer: Any) -> bool:
    return bool(
        answer is not None
        and answer.done()
        and any(value.bool_value for value in answer.result().values)
    )
