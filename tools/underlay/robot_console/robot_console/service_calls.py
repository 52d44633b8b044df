# SPDX-License-Identifier: Apache-2.0
"""Non-blocking service calls."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
import time
from typing import Any, TYPE_CHECKING

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['Answer', 'ServiceCalls']

Answer = Callable[[Any, str], None]
"""Called with the response and '', or with None and an error message."""


@dataclass
class _Call:
    """A pending service call."""

    client: Any
    request: Any
    answer: Answer
    timeout_s: float
    end_s: float
    future: Any = None


class ServiceCalls:
    """
    Calls services without blocking; `update` completes each call with a response or an error.

    Parameters
    ----------
    node
        The node that owns the clients. It is used in its own thread only.

    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._calls: list[_Call] = []

    def call(
        self, kind: Any, name: str, request: Any, answer: Answer, timeout_s: float = 5.0
    ) -> None:
        """
        Call a service as soon as its server is available.

        Parameters
        ----------
        kind
            The class of the service type.
        name
            The name of the service.
        request
            An instance of the request class of `kind`.
        answer
            Called once, with the response and '', or with None and an error message: at once for
            an invalid name, otherwise by `update`.
        timeout_s
            The timeout for the connection and the response together, in s.

        """
        try:
            client = self._node.create_client(kind, name)
        except Exception as error:  # rclpy raises several exceptions for invalid names
            answer(None, f"'{name}' cannot be called: {error}")
            return
        end_s = time.monotonic() + timeout_s
        self._calls.append(_Call(client, request, answer, timeout_s, end_s))

    def update(self) -> None:
        """Send requests whose servers are available, and complete finished calls."""
        for call in list(self._calls):
            if call.future is None and call.client.service_is_ready():
                call.future = call.client.call_async(call.request)
            outcome = self._outcome(call)
            if outcome is not None:
                self._calls.remove(call)
                self._node.destroy_client(call.client)
                call.answer(*outcome)

    def close(self) -> None:
        """Cancel all calls without a response."""
        for call in self._calls:
            self._node.destroy_client(call.client)
        self._calls.clear()

    def _outcome(self, call: _Call) -> tuple[Any, str] | None:
        """Return the result of a call, or None while it is pending."""
        name, future = call.client.srv_name, call.future
        if future is not None and future.done():
            error = future.exception()
            return (None, f"'{name}' failed: {error}") if error else (future.result(), '')
        if future is not None and not call.client.service_is_ready():
            return None, f"'{name}' disappeared before it responded."
        if time.monotonic() < call.end_s:
            return None
        if future is not None:
            return None, f"'{name}' did not respond within {call.timeout_s:g} s."
        if not self._node.count_services(name):
            return None, f"No server for '{name}'."
        return None, (
            f"'{name}' does not connect within {call.timeout_s:g} s: its process may be stopped "
            'or shutting down, or the service has another type.'
        )
