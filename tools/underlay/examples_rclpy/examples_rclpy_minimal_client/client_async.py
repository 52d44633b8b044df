# SPDX-License-Identifier: Apache-2.0
"""A client whose loop looks whether there is a response, and could do something else."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import count
import sys

from demo_nodes_py.services.waiting import wait_for_service
from example_interfaces.srv import AddTwoInts
from examples_rclpy_minimal_client.client_async_member_function import NUMBERS, report
from rclpy.node import Node
from tf2_ros.executing import sleep
from tf2_ros.program import run_node

__all__ = ['main']

LOOK_S = 0.1
LOOKS_UNTIL_REPEAT = 20
"""A response is lost if the service sends it before it has discovered the client."""


async def _ask(node: Node) -> None:
    client = node.create_client(AddTwoInts, 'add_two_ints')
    await wait_for_service(node, client.service_is_ready)
    for look in count():
        if look % LOOKS_UNTIL_REPEAT == 0:
            future = client.call_async(AddTwoInts.Request(**NUMBERS))
        await sleep(node, LOOK_S)
        if future.done():
            break
    report(node, future.result())


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: Node('minimal_client_async'), args, _ask)


if __name__ == '__main__':
    sys.exit(main())
