# SPDX-License-Identifier: Apache-2.0
"""The main function of the servers' executables: spin one node until a signal."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from nav2_util.errors import NavigationError
from rclpy.node import Node
from tf2_ros.program import run_node

__all__ = ['main']


def main(kind: Callable[..., Any]) -> int:
    """
    Spin a node of a class until SIGINT or SIGTERM; return the exit status.

    Parameters
    ----------
    kind
        The class, whose constructor is called without arguments.

    """

    def make_node(_: list[str]) -> Node:
        try:
            node: Node = kind()
        except NavigationError as error:
            raise ValueError(str(error)) from error  # one message without a traceback
        return node

    return run_node(make_node)
