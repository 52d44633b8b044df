# SPDX-License-Identifier: Apache-2.0
"""A node that adds two integers as a service."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from example_interfaces.srv import AddTwoInts
from rclpy.node import Node
from tf2_ros.program import run_node

__all__ = ['AddTwoIntsServer', 'main']


class AddTwoIntsServer(Node):
    """
    Offers the service `add_two_ints`.

    Parameters
    ----------
    name
        The name of the node.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, name: str = 'add_two_ints_server', **options: Any) -> None:
        super().__init__(name, **options)
        self.srv = self.create_service(AddTwoInts, 'add_two_ints', self.add_two_ints_callback)

    def add_two_ints_callback(
        self, request: AddTwoInts.Request, response: AddTwoInts.Response
    ) -> AddTwoInts.Response:
        """
        Log a request, and compute the sum.

        Parameters
        ----------
        request
            The numbers.
        response
            Gets the sum.

        Returns
        -------
        AddTwoInts.Response
            The response.

        """
        self.get_logger().info(f'Incoming request\na: {request.a} b: {request.b}')
        return self.add(request, response)

    def add(
        self, request: AddTwoInts.Request, response: AddTwoInts.Response
    ) -> AddTwoInts.Response:
        """
        Compute the sum; one that has more than 64 bits wraps around, as in C++.

        Parameters
        ----------
        request, response
            As for `add_two_ints_callback`.

        """
        response.sum = (request.a + request.b + 2**63) % 2**64 - 2**63
        return response


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: AddTwoIntsServer(), args)


if __name__ == '__main__':
    sys.exit(main())
