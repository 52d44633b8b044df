# SPDX-License-Identifier: Apache-2.0
"""A service without a class: a local function answers requests."""

from __future__ import annotations

from collections.abc import Sequence
import sys

from example_interfaces.srv import AddTwoInts
from rclpy.node import Node
from tf2_ros.program import run_node

__all__ = ['main']


def _make_node(_: list[str]) -> Node:
    node = Node('minimal_service')

    def add(request: AddTwoInts.Request, response: AddTwoInts.Response) -> AddTwoInts.Response:
        node.get_logger().info(f'Incoming request\na: {request.a} b: {request.b}')
        # A sum that has more than 64 bits wraps around, as in C++.
        response.sum = (request.a + request.b + 2**63) % 2**64 - 2**63
        return response

    node.create_service(AddTwoInts, 'add_two_ints', add)
    return node


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(_make_node, args)


if __name__ == '__main__':
    sys.exit(main())
