# SPDX-License-Identifier: Apache-2.0
"""
Wait for a condition, a point in time or the response of a service, while a node spins.

What a command waits for is reported to the user after a while. Importing this does not import
rclpy.
"""

from __future__ import annotations

from collections.abc import Callable
import sys
import time
from typing import Any

PATIENCE_S = 2.0
PERIOD_S = 0.05
CONNECTION_TIMEOUT_S = 5.0


class Patience:
    """
    Reports once, on stderr, what a command waits for, after 2 s of waiting.

    Parameters
    ----------
    what
        The subject of the wait, as in "Still waiting for ...".
    hint
        Called with the report; returns a hint, or ''.

    """

    def __init__(self, what: str, hint: Callable[[], str] = str) -> None:
        self._what = what
        self._hint = hint
        self._end = time.monotonic() + PATIENCE_S

    def check(self) -> None:
        """Print the report if it is due."""
        if time.monotonic() > self._end:
            text = f'Still waiting for {self._what} (Ctrl-C to stop)'
            print('. '.join(filter(None, (text, self._hint()))), file=sys.stderr)
            self._end = float('inf')


def wait_until(
    node: Any,
    is_true: Callable[[], object],
    patience: Patience | None,
    timeout_s: float = float('inf'),
) -> bool:
    """
    Spin a node until a condition is true.

    Parameters
    ----------
    node
        The node.
    is_true
        The condition, which is checked between callbacks.
    patience
        Reports the wait to the user; None for no report.
    timeout_s
        The timeout in s.

    Returns
    -------
    bool
        Whether it became true in time.

    """
    end = time.monotonic() + timeout_s
    while not is_true():
        if time.monotonic() > end:
            return False
        if patience:
            patience.check()
        node.spin_once(PERIOD_S)
    return True


def spin_until(node: Any, end_s: float) -> None:
    """
    Spin a node until a point in time, at least once.

    Parameters
    ----------
    node
        The node.
    end_s
        The end time, in s of the monotonic clock.

    """
    while True:
        left_s = end_s - time.monotonic()
        node.spin_once(max(0.0, left_s))
        if left_s <= 0.0:
            return


def wait_for_response(node: Any, client: Any, future: Any, timeout_s: float = float('inf')) -> Any:
    """
    Wait for the response to a service call.

    Parameters
    ----------
    node
        The node to spin while waiting.
    client
        The client of the service.
    future
        The future of the call.
    timeout_s
        The timeout in s.

    Returns
    -------
    Any
        The response.

    Raises
    ------
    RuntimeError
        The service disappears, or does not respond in time.

    """
    name = client.srv_name

    def is_over() -> bool:
        return bool(future.done() or not client.service_is_ready())

    if not wait_until(node, is_over, Patience(f"the answer of '{name}'"), timeout_s):
        raise RuntimeError(f"The service '{name}' has not answered within {timeout_s:g} s")
    if not future.done():
        raise RuntimeError(f"The service '{name}' disappeared before it answered")
    return future.result()


def call(
    node: Any, service_type: Any, name: str, request: Any, timeout_s: float = float('inf')
) -> Any:
    """
    Call a service of a node that is known to exist.

    Parameters
    ----------
    node
        The node that calls it, and that is spun while waiting.
    service_type
        The class of the service.
    name
        The full name of the service.
    request
        The request.
    timeout_s
        The timeout for the response, in s; the connection may take another 5 s.

    Returns
    -------
    Any
        The response.

    Raises
    ------
    RuntimeError
        The service does not connect, disappears, or does not respond in time.

    """
    client = node.create_client(service_type, name)
    try:
        patience = Patience(f"the service '{name}'")
        if not wait_until(node, client.service_is_ready, patience, CONNECTION_TIMEOUT_S):
            raise RuntimeError(
                f"The service '{name}' did not connect within {CONNECTION_TIMEOUT_S:g} s: "
                'its process may be stopped or shutting down'
            )
        return wait_for_response(node, client, client.call_async(request), timeout_s)
    finally:
        node.destroy_client(client)
