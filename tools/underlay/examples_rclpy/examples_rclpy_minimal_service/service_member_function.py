# SPDX-License-Identifier: Apache-2.0
"""A service of a class, whose member function answers requests."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from demo_nodes_py.services.add_two_ints_server import AddTwoIntsServer
from tf2_ros.program import run_node

__all__ = ['MinimalService', 'main']


class MinimalService(AddTwoIntsServer):
    """
    Offers the service `add_two_ints`.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('minimal_service', **options)


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: MinimalService(), args)


if __name__ == '__main__':
    sys.exit(main())
