# SPDX-License-Identifier: Apache-2.0
"""Republish images over other transports: `ros2 run image_transport republish`."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import TYPE_CHECKING

from tf2_ros.program import run_node

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['main']

USAGE = (
    'Usage: ros2 run image_transport republish [IN_TRANSPORT [OUT_TRANSPORT]] --ros-args '
    '-r in:=IMAGE_TOPIC -r out:=IMAGE_TOPIC'
)


def _make_node(words: list[str]) -> Node:
    """Create the node from its arguments: at most the two transports."""
    from image_transport.republisher import Republisher

    # rcl itself applies remappings without --ros-args, and warns that they are deprecated.
    transports = [word for word in words if ':=' not in word]
    if len(transports) > 2 or any(word.startswith('-') for word in transports):
        raise ValueError(
            f'republish takes at most two transports and no options, not {" ".join(transports)}; '
            f'remappings and parameters follow --ros-args.\n{USAGE}'
        )
    return Republisher(*transports)


def main(args: Sequence[str] | None = None) -> None:
    """
    Run republish; exit with its status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    sys.exit(run_node(_make_node, args))


if __name__ == '__main__':
    main()
