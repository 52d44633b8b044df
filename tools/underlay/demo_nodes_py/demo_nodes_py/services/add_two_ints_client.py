# SPDX-License-Identifier: Apache-2.0
"""A node that has a service add 2 and 3."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from demo_nodes_py.services.waiting import wait_for_service
from example_interfaces.srv import AddTwoInts
from rclpy.node import Node
from tf2_ros.executing import response_of
from tf2_ros.program import run_node

__all__ = ['AddTwoIntsClient', 'main']


class AddTwoIntsClient(Node):
    """
    Calls the service `add_two_ints`.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('add_two_ints_client', **options)
        self._client = self.create_client(AddTwoInts, 'add_two_ints')

    async def add(self) -> None:
        """Call the service once it is available, and log the sum."""
        await wait_for_service(self, self._client.service_is_ready)
        request = AddTwoInts.Request(a=2, b=3)
        response = await response_of(self, lambda: self._client.call_async(request))
        self.get_logger().info(f'Result of add_two_ints: {response.sum}')


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: AddTwoIntsClient(), args, AddTwoIntsClient.add)


if __name__ == '__main__':
    sys.exit(main())
