# SPDX-License-Identifier: Apache-2.0
"""The body of the programs of this package."""

from __future__ import annotations

from collections.abc import Callable, Sequence
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rclpy.node import Node


def run(arguments: Sequence[str], make_node: Callable[[], Node]) -> int:
    """Run a node until SIGINT or SIGTERM; return the exit status."""
    import rclpy
    from rclpy.executors import ExternalShutdownException

    try:
        rclpy.init(args=list(arguments))
        rclpy.spin(make_node())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    except RuntimeError as error:
        sys.stderr.write(
            f'The ROS arguments cannot be used: {error}. Correct what follows --ros-args.\n'
        )
        return 1
    finally:
        rclpy.try_shutdown()
    return 0


def own_arguments(arguments: Sequence[str]) -> list[str]:
    """Return the arguments without those for ROS, and without the name of the program."""
    from rclpy.utilities import remove_ros_args

    return list(remove_ros_args(list(arguments)))[1:]
