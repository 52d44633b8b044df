# SPDX-License-Identifier: Apache-2.0
"""The body of the programs for transforms."""

from __future__ import annotations

from collections.abc import Callable
import sys
from typing import TypeVar

ArgumentsT = TypeVar('ArgumentsT')


def run(parse: Callable[[list[str]], ArgumentsT], work: Callable[[ArgumentsT], int | None]) -> int:
    """
    Do the work until it is done, or until SIGINT or SIGTERM; return the exit status.

    :param parse: makes the work's arguments of the words that are not for ROS
    :param work: runs while ROS does; may return an exit status
    """
    import rclpy
    from rclpy.executors import ExternalShutdownException

    try:
        arguments = _start(parse)
        return 1 if arguments is None else work(arguments) or 0
    except (KeyboardInterrupt, ExternalShutdownException):
        return 0
    finally:
        rclpy.try_shutdown()


def _start(parse: Callable[[list[str]], ArgumentsT]) -> ArgumentsT | None:
    """Start ROS and return the arguments, or None after a sentence about those for ROS."""
    import rclpy
    from rclpy.utilities import remove_ros_args

    try:
        arguments = parse(list(remove_ros_args(sys.argv))[1:])
        rclpy.init(args=sys.argv)
    except RuntimeError as error:
        sys.stderr.write(
            f'The ROS arguments cannot be used: {error}. Correct what follows --ros-args.\n'
        )
        return None
    return arguments
