# SPDX-License-Identifier: Apache-2.0
"""Send the requests of recorded services again, as a client of each."""

from __future__ import annotations

import time
from typing import Any

from rclpy.serialization import deserialize_message
from ros2bag.storage.metadata import Topic
from ros2bag.storage.service_events import service_of
from ros2cli.messages.lookup import get_message, get_passed_type
from service_msgs.msg import ServiceEventInfo

__all__ = ['SOURCES', 'ServiceOutlet']

SOURCES = {
    'service_introspection': ServiceEventInfo.REQUEST_RECEIVED,
    'client_introspection': ServiceEventInfo.REQUEST_SENT,
}
"""The kind of the events that have the requests, by who has published them."""
PERIOD_S = 0.02


class ServiceOutlet:
    """
    Client of a service whose recorded requests are sent again.

    Parameters
    ----------
    node
        The node that sends them.
    topic
        The topic with the events of the service.
    name
        The name that the topic with the events has now, from which that of the service follows.
    source
        One of `SOURCES`: whose events have the requests.

    Raises
    ------
    UnknownType, RuntimeError
        The type of the service is not installed.

    """

    def __init__(self, node: Any, topic: Topic, name: str, source: str) -> None:
        service = service_of(name, topic.type_name)
        if service is None:
            raise RuntimeError(f"'{name}' is not the name of the events of a service")
        self._node, self._kind, self._name = node, SOURCES[source], service.name
        self._event_type = get_message(topic.type_name)
        self._client = node.create_client(get_passed_type(service.type_name, 'srv'), service.name)
        self._pending: list[Any] = []
        self._is_warned: set[str] = set()

    @property
    def service(self) -> str:
        """Return the full name of the service."""
        return self._name

    def is_ready(self) -> bool:
        """Whether a server is connected."""
        return bool(self._client.service_is_ready())

    def publish(self, data: bytes) -> None:
        """
        Send a request, if a recorded event has one from the chosen source.

        Parameters
        ----------
        data
            The serialized event.

        """
        event = deserialize_message(data, self._event_type)
        if event.info.event_type != self._kind:
            return
        if not event.request:
            self._warn('its events have no contents: record it with CONTENTS introspection')
        elif not self.is_ready():
            self._warn('no server offers it now')
        else:
            self._pending = [future for future in self._pending if not future.done()]
            self._pending.append(self._client.call_async(event.request[0]))

    def wait_until_answered(self, end_s: float) -> None:
        """
        Wait for the responses.

        Parameters
        ----------
        end_s
            Until when to wait, by the monotonic clock.

        """
        while any(not each.done() for each in self._pending) and time.monotonic() < end_s:
            self._node.spin_once(PERIOD_S)

    def _warn(self, reason: str) -> None:
        if reason not in self._is_warned:
            self._is_warned.add(reason)
            self._node.get_logger().warning(
                f"Requests of the service '{self._name}' are not sent: {reason}"
            )
