# SPDX-License-Identifier: Apache-2.0
"""A listener that also hears publishers that offer no more than best effort."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from demo_nodes_py.topics.listener import Listener
from rclpy.qos import qos_profile_sensor_data
from tf2_ros.program import run_node

__all__ = ['ListenerBestEffort', 'main']


class ListenerBestEffort(Listener):
    """
    Listener with the QoS of sensor data.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__(qos=qos_profile_sensor_data, **options)


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: ListenerBestEffort(), args)


if __name__ == '__main__':
    sys.exit(main())
