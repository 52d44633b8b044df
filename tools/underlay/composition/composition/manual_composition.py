# SPDX-License-Identifier: Apache-2.0
"""A program that runs four components, which it names, in one process."""

from __future__ import annotations

from collections.abc import Sequence
import sys

from composition.components import Client, Listener, Server, Talker
from rclpy.node import Node
from tf2_ros.program import run_node

__all__ = ['main']


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the components; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """

    def make(_: list[str]) -> Node:
        talker: Node = Talker()
        talker.companions = (Listener(), Server(), Client())
        return talker

    return run_node(make, args)


if __name__ == '__main__':
    sys.exit(main())
