# SPDX-License-Identifier: Apache-2.0
"""A talker with its listener, and a server with its client."""

from __future__ import annotations

from typing import Any

from demo_nodes_cpp.talker import Talker
from demo_nodes_py.services.add_two_ints_server import AddTwoIntsServer
from demo_nodes_py.topics.listener import Listener
from example_interfaces.srv import AddTwoInts
from rclpy.node import Node
from rclpy.task import Future

__all__ = ['Client', 'Listener', 'Server', 'Talker']

PERIOD_S = 2.0
NUMBERS = {'a': 2, 'b': 3}


class Server(AddTwoIntsServer):
    """
    Server of `add_two_ints`, under the name of its component.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('Server', **options)

    def add_two_ints_callback(
        self, request: AddTwoInts.Request, response: AddTwoInts.Response
    ) -> AddTwoInts.Response:
        """
        Compute the sum.

        Parameters
        ----------
        request, response
            As for `AddTwoIntsServer.add_two_ints_callback`.

        """
        self.get_logger().info(f'Incoming request: [a: {request.a}, b: {request.b}]')
        return self.add(request, response)


class Client(Node):
    """
    Client that asks for a sum every two seconds.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('Client', **options)
        self._client = self.create_client(AddTwoInts, 'add_two_ints')
        self._future: Future | None = None
        self.create_timer(PERIOD_S, self.on_timer)

    def on_timer(self) -> None:
        """Ask again, whether or not the last request was answered."""
        if not self._client.service_is_ready():
            self.get_logger().info('Service not available after waiting')
            return
        if self._future is not None:
            self._client.remove_pending_request(self._future)
        self._future = self._client.call_async(AddTwoInts.Request(**NUMBERS))
        self._future.add_done_callback(self._on_answer)

    def _on_answer(self, future: Future) -> None:
        if not future.cancelled():
            self.get_logger().info(f'Got result: [{future.result().sum}]')
