# SPDX-License-Identifier: Apache-2.0
"""Call a service, and wait for it and for its answer."""

from __future__ import annotations

import time
from typing import Any, TYPE_CHECKING

import rclpy

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['ServiceNotFoundError', 'bcolors', 'service_caller']

_LOOK_S = 0.2
_REPORT_S = 10.0


class ServiceNotFoundError(Exception):
    """A service did not appear in time."""


class bcolors:  # noqa: N801
    """Escape sequences that colour and style text on a terminal."""

    MAGENTA = '\033[95m'
    OKBLUE = '\033[94m'
    OKCYAN = '\033[96m'
    OKGREEN = '\033[92m'
    WARNING = '\033[93m'
    FAIL = '\033[91m'
    ENDC = '\033[0m'
    BOLD = '\033[1m'
    UNDERLINE = '\033[4m'


def service_caller(
    node: Node,
    service_name: str,
    service_type: Any,
    request: Any,
    service_timeout: float = 0.0,
    call_timeout: float = 10.0,
    max_attempts: int = 3,
) -> Any:
    """
    Call a service, and spin the node until it has answered.

    Parameters
    ----------
    node
        The node that calls; nobody else may spin it.
    service_name
        The name of the service.
    service_type
        Its type.
    request
        The request.
    service_timeout
        How long to wait for the service, in s; 0 for no limit.
    call_timeout
        How long to wait for each answer, in s.
    max_attempts
        How often the request is sent if no answer comes.

    Raises
    ------
    ServiceNotFoundError
        The service has not appeared.
    RuntimeError
        It has not answered.

    """
    client = node.create_client(service_type, node.resolve_service_name(service_name))
    try:
        _wait_for_service(node, client, service_timeout)
        for _ in range(max_attempts):
            future = client.call_async(request)
            if _answers(node, future, call_timeout):
                return future.result()
            client.remove_pending_request(future)
            node.get_logger().warning(
                f"The service '{client.srv_name}' has not answered for {call_timeout:g} s"
            )
    finally:
        node.destroy_client(client)
    raise RuntimeError(
        f"The service '{client.srv_name}' has not answered {max_attempts} requests: its process "
        'may be stopped or too busy'
    )


def _wait_for_service(node: Node, client: Any, timeout_s: float) -> None:
    """Wait for a service, and say now and then what is waited for."""
    start_s = reported_s = time.monotonic()
    while not client.service_is_ready():
        now_s = time.monotonic()
        if timeout_s and now_s > start_s + timeout_s:
            raise ServiceNotFoundError(
                f"There is no service '{client.srv_name}' after {timeout_s:g} s: is the "
                'controller manager running, and is that its name?'
            )
        if now_s > reported_s + _REPORT_S:
            reported_s = now_s
            node.get_logger().info(f"Waiting for the service '{client.srv_name}'")
        _spin_once(node)


def _answers(node: Node, future: Any, timeout_s: float) -> bool:
    """Spin until there is an answer, in pieces so that a signal is noticed; return whether."""
    end_s = time.monotonic() + timeout_s
    while not future.done() and time.monotonic() < end_s:
        _spin_once(node)
    return bool(future.done())


def _spin_once(node: Node) -> None:
    """Spin a node once, with the executor that it is in, if any."""
    executor = node.executor
    # A node keeps its last executor when it is taken out of it.
    if executor is not None and node in executor.get_nodes():
        executor.spin_once(timeout_sec=_LOOK_S)
    else:
        rclpy.spin_once(node, timeout_sec=_LOOK_S)
