# SPDX-License-Identifier: Apache-2.0
"""Call a service and print the request and the response."""

from __future__ import annotations

import time
from typing import Any

from ros2cli.messages.lookup import type_name
from ros2cli.messages.outgoing import OutgoingMessage
from ros2cli.node.calls import wait_for_response
from ros2cli.node.waiting import spin_until, wait_until
from ros2cli.patience import Patience
from ros2service.api import get_service_types, service_hint


class Caller:
    """
    Service client that prints the requests and responses.

    The client is created at once, but may connect later: call `wait_for_service` first.

    Parameters
    ----------
    node
        The `DirectNode` that calls.
    service_type
        The class of the service.
    name
        Full name of the service.

    """

    def __init__(self, node: Any, service_type: Any, name: str) -> None:
        self._node = node
        self._client = node.create_client(service_type, name)
        self._name = name
        self._type_name = type_name(service_type)

    def wait_for_service(self) -> None:
        """Wait for the service without a timeout, and report if it is not available at once."""
        if not self._is_offered():
            print('waiting for service to become available...')
        patience = Patience(f"the service '{self._name}'", self._hint)
        wait_until(self._node, self._client.service_is_ready, patience)

    def call_repeatedly(self, request: OutgoingMessage, rate_hz: float | None) -> None:
        """
        Call the service once, or endlessly at a rate.

        Parameters
        ----------
        request
            The request; its time stamps are updated for each call.
        rate_hz
            Calls per second, each after the response to the last one; None for a single call.

        Raises
        ------
        RuntimeError
            The service disappears before it responds.

        """
        next_s = time.monotonic()
        while True:
            self._call(request.stamped(self._node.get_clock().now().to_msg()))
            if rate_hz is None:
                return
            next_s += 1.0 / rate_hz
            spin_until(self._node, next_s)

    def _call(self, request: Any) -> None:
        print(f'requester: making request: {request!r}\n')
        future = self._client.call_async(request)
        response = wait_for_response(self._node, self._client, future)
        print(f'response:\n{response!r}\n')

    def _is_offered(self) -> bool:
        """Whether the service is offered with this type, and is therefore about to connect."""
        graph = self._node.graph
        types = get_service_types(graph, self._name)
        return bool(graph.count_services(self._name)) and self._type_name in types

    def _hint(self) -> str:
        return service_hint(self._node.graph, self._name, self._type_name)
