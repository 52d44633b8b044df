# SPDX-License-Identifier: Apache-2.0
"""Calls of services that block nobody."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
import time
from typing import Any, TYPE_CHECKING

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['Answer', 'ServiceCalls']

Answer = Callable[[Any, str], None]
"""Takes the response and '', or None and a sentence about why there is none."""


@dataclass
class _Call:
    """A call that has not been answered yet."""

    client: Any
    request: Any
    answer: Answer
    timeout_s: float
    end_s: float
    future: Any = None


class ServiceCalls:
    """
    Calls services without blocking; `update` ends each call with a response or a reason.

    Parameters
    ----------
    node
        The node that has the clients. It is used in its own thread only.

    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._calls: list[_Call] = []

    def call(
        self, kind: Any, name: str, request: Any, answer: Answer, timeout_s: float = 5.0
    ) -> None:
        """
        Call a service as soon as its client has connected.

        Parameters
        ----------
        kind
            The class of the service.
        name
            The name of the service.
        request
            An instance of the request class of `kind`.
        answer
            Called once, with the response, or with None and a sentence on why there is none: at
            once for an invalid name, otherwise by `update`.
        timeout_s
            How long to wait for the connection and the response together, in s.

        """
        try:
            client = self._node.create_client(kind, name)
        except Exception as error:  # rclpy has no one exception for bad names
            answer(None, f"'{name}' cannot be called: {error}")
            return
        end_s = time.monotonic() + timeout_s
        self._calls.append(_Call(client, request, answer, timeout_s, end_s))

    def update(self) -> None:
        """Go on with what is to be done, and tell what is over."""
        for call in list(self._calls):
            if call.future is None and call.client.service_is_ready():
                call.future = call.client.call_async(call.request)
            outcome = self._outcome(call)
            if outcome is not None:
                self._calls.remove(call)
                self._node.destroy_client(call.client)
                call.answer(*outcome)

    def close(self) -> None:
        """Forget all calls, without an answer."""
        for call in self._calls:
            self._node.destroy_client(call.client)
        self._calls.clear()

    def _outcome(self, call: _Call) -> tuple[Any, str] | None:
        """Return what a call ended with, or None if it goes on."""
        name, future = call.client.srv_name, call.future
        if future is not None and future.done():
            error = future.exception()
            return (None, f"'{name}' failed: {error}") if error else (future.result(), '')
        if future is not None and not call.client.service_is_ready():
            return None, f"'{name}' has gone away before it answered."
        if time.monotonic() < call.end_s:
            return None
        if future is not None:
            return None, f"'{name}' has not answered within {call.timeout_s:g} s."
        if not self._node.count_services(name):
            return None, f"Nobody offers '{name}'."
        return None, (
            f"'{name}' does not connect within {call.timeout_s:g} s: its process may be stopped, "
            'or just be ending, or the service has another type.'
        )
