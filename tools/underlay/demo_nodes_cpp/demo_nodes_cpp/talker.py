# SPDX-License-Identifier: Apache-2.0
"""The talker."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from demo_nodes_py.topics import talker
from tf2_ros.program import run_node

__all__ = ['Talker', 'main']


class Talker(talker.Talker):
    """
    Talker that counts from 1 and keeps the last 7 messages.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__(qos=7, first=1, quote="'", **options)


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: Talker(), args)


if __name__ == '__main__':
    sys.exit(main())
