# SPDX-License-Identifier: Apache-2.0
"""Asynchronous services, and service calls with a timeout; both in coroutines."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from typing import Any, TYPE_CHECKING

from nav2_util.errors import NavigationError
from nav2_util.timing import steady_clock
from rclpy.task import Future

if TYPE_CHECKING:
    from rclpy.client import Client
    from rclpy.node import Node
    from rclpy.service import Service

__all__ = ['ServiceError', 'call', 'create_async_service', 'wait_for']

_LOOK_S = 0.05


class ServiceError(NavigationError):
    """A service is not available, or has not responded."""


def create_async_service(
    node: Node, kind: Any, name: str, callback: Callable[[Any, Any], Awaitable[Any]]
) -> Service:
    """
    Create a service whose callback is a coroutine function.

    Parameters
    ----------
    node, kind, name
        As for `Node.create_service`.
    callback
        Accepts request and response, and returns the response when it is ready.

    """
    headers: list[Any] = []

    def begin(request: Any, response: Any) -> None:
        headers.append((request, response))

    async def answer(request: Any, response: Any, header: Any) -> None:
        send(await callback(request, response), header)

    def send_later(_: Any, header: Any) -> None:
        if node.executor is not None:
            node.executor.create_task(answer, *headers.pop(), header)

    service = node.create_service(kind, name, begin)
    send = service.send_response
    service.send_response = send_later
    return service


async def wait_for(node: Node, future: Future[Any], timeout_s: float) -> bool:
    """
    Wait until a future is done, or until a timeout on a steady clock.

    Parameters
    ----------
    node
        The node whose executor resumes the coroutine.
    future
        The future.
    timeout_s
        The timeout in s, even while simulated time is paused.

    Returns
    -------
    bool
        Whether the future is done.

    """
    if future.done():
        return True
    end: Future[None] = Future(executor=node.executor)

    def finish(_: Any = None) -> None:
        if not end.done():
            end.set_result(None)

    timer = node.create_timer(timeout_s, finish, clock=steady_clock())
    future.add_done_callback(finish)
    try:
        await end
    finally:
        node.destroy_timer(timer)
    return bool(future.done())


async def call(node: Node, client: Client, request: Any, timeout_s: float) -> Any:
    """
    Call a service and return its response.

    Parameters
    ----------
    node, client
        The node whose executor resumes the coroutine, and its client.
    request
        The request to send.
    timeout_s
        The total timeout in s for the service to become available and to respond.

    Raises
    ------
    ServiceError
        The service is not available, or does not respond, within the timeout.

    """
    left_s = timeout_s
    while not client.service_is_ready():
        if left_s <= 0.0:
            raise ServiceError(f"The service '{client.srv_name}' is not available.")
        await wait_for(node, Future(), _LOOK_S)
        left_s -= _LOOK_S
    answer = client.call_async(request)
    if not await wait_for(node, answer, max(left_s, _LOOK_S)):
        client.remove_pending_request(answer)
        raise ServiceError(
            f"The service '{client.srv_name}' has not answered within {timeout_s:g} s."
        )
    return answer.result()
