# SPDX-License-Identifier: Apache-2.0
"""The diagnostics that running nodes publish on the `diagnostics` topics."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from typing import Any, NamedTuple

DIAGNOSTICS_TYPE = 'diagnostic_msgs/msg/DiagnosticArray'
WARN = 1


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
