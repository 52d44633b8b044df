# SPDX-License-Identifier: Apache-2.0
"""A node that logs what the talker publishes, and its transitions."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from lifecycle_msgs.msg import TransitionEvent
from rclpy.node import Node
from std_msgs.msg import String
from tf2_ros.program import run_node

__all__ = ['LifecycleListener', 'main']


class LifecycleListener(Node):
    """
    Logs the messages of `lifecycle_chatter` and the transitions of `lc_talker`.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('lc_listener', **options)
        self.create_subscription(String, 'lifecycle_chatter', self.data_callback, 10)
        self.create_subscription(
            TransitionEvent, 'lc_talker/transition_event', self.notification_callback, 10
        )

    def data_callback(self, msg: String) -> None:
        """
        Log a text.

        Parameters
        ----------
        msg
            The message.

        """
        self.get_logger().info(f'data_callback: {msg.data}')

    def notification_callback(self, msg: TransitionEvent) -> None:
        """
        Log a transition.

        Parameters
        ----------
        msg
            The states before and after.

        """
        self.get_logger().info(
            f'notify callback: Transition from state {msg.start_state.label} to '
            f'{msg.goal_state.label}'
        )


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: LifecycleListener(), args)


if __name__ == '__main__':
    sys.exit(main())
