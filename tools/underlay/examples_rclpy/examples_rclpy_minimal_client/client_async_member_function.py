# SPDX-License-Identifier: Apache-2.0
"""A client that is a class, whose coroutine awaits the response."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from demo_nodes_py.services.waiting import wait_for_service
from example_interfaces.srv import AddTwoInts
from rclpy.node import Node
from tf2_ros.executing import response_of
from tf2_ros.program import run_node

__all__ = ['MinimalClientAsync', 'main', 'report']

NUMBERS = {'a': 41, 'b': 1}


def report(node: Node, response: AddTwoInts.Response) -> None:
    """
    Log the sum of the numbers.

    Parameters
    ----------
    node
        The node that has asked.
    response
        The response of the service.

    """
    a, b = NUMBERS.values()
    node.get_logger().info(f'Result of add_two_ints: for {a} + {b} = {response.sum}')


class MinimalClientAsync(Node):
    """
    Calls the service `add_two_ints`.

    Parameters
    ----------
    name
        The name of the node.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, name: str = 'minimal_client_async', **options: Any) -> None:
        super().__init__(name, **options)
        self.cli = self.create_client(AddTwoInts, 'add_two_ints')

    async def send_request(self) -> None:
        """Call the service once it is available, and log the sum."""
        await wait_for_service(self, self.cli.service_is_ready)
        request = AddTwoInts.Request(**NUMBERS)
        report(self, await response_of(self, lambda: self.cli.call_async(request)))


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: MinimalClientAsync(), args, MinimalClientAsync.send_request)


if __name__ == '__main__':
    sys.exit(main())
