# SPDX-License-Identifier: Apache-2.0
"""Waiting for a service, in coroutines."""

from __future__ import annotations

from collections.abc import Callable
from itertools import count
from typing import TYPE_CHECKING

from tf2_ros.executing import sleep

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['wait_for_service']

_LOOK_S = 0.1
_LOOKS_UNTIL_LOG = 10


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
