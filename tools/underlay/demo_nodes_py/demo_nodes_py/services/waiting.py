# SPDX-License-Identifier: Apache-2.0
"""Waiting for a service and for its response, in coroutines."""

from __future__ import annotations

from collections.abc import Callable
from itertools import count
from typing import Any, TYPE_CHECKING

from tf2_ros.executing import sleep

if TYPE_CHECKING:
    from rclpy.client import Client
    from rclpy.node import Node
    from rclpy.task import Future

__all__ = ['response_of', 'wait_for_service']

_LOOK_S = 0.1
_LOOKS_UNTIL_LOG = 10
_LOOKS_UNTIL_REPEAT = 20


async def wait_for_service(node: Node, is_ready: Callable[[], bool]) -> None:
    """
    Wait until a service is available, and log once per second that it is not.

    Parameters
    ----------
    node
        The node of the client.
    is_ready
        Whether the service is available.

    """
    for look in count(1):
        if is_ready():
            return
        if look % _LOOKS_UNTIL_LOG == 0:
            node.get_logger().info('service not available, waiting again...')
        await sleep(node, _LOOK_S)


async def response_of(node: Node, client: Client, request: Any) -> Any:
    """
    Call a service that is available, and return its response.

    The request is repeated every two seconds, since a response is lost if the server sends it
    before it has discovered the client; so the service must tolerate a second request.

    Parameters
    ----------
    node
        The node of the client.
    client
        The client.
    request
        The request to send.

    """
    answers: list[Future[Any]] = []
    looks = 0
    while not any(answer.done() for answer in answers):
        if looks % _LOOKS_UNTIL_REPEAT == 0:
            answers.append(client.call_async(request))
        looks += 1
        await sleep(node, _LOOK_S)
    return next(answer.result() for answer in answers if answer.done())
