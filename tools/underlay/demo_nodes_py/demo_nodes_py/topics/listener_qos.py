# SPDX-License-Identifier: Apache-2.0
"""A listener whose quality of service is chosen on the command line."""

from __future__ import annotations

from collections.abc import Sequence
import sys

from demo_nodes_py.topics.listener import Listener
from demo_nodes_py.topics.qos_program import Countdown, describe, run_until_counted
from rclpy.qos import QoSProfile
from std_msgs.msg import String

__all__ = ['ListenerQos', 'main']


class ListenerQos(Listener):
    """
    Logs messages of the topic `chatter` with a given quality of service.

    Parameters
    ----------
    qos_profile
        The quality of service.
    count
        The number of messages that `countdown` counts.

    """

    def __init__(self, qos_profile: QoSProfile, count: int | None = None) -> None:
        super().__init__('listener_qos', qos_profile)
        self.countdown = Countdown(count)
        self.get_logger().info(f'{describe(qos_profile)} listener')

    def chatter_callback(self, msg: String) -> None:
        """
        Log a message, and count it, unless it comes after the last one.

        Parameters
        ----------
        msg
            The message.

        """
        if not self.countdown.is_over:
            super().chatter_callback(msg)
            self.countdown.count()


def main(argv: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    argv : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_until_counted(ListenerQos, 'listener_qos', 'received', argv)


if __name__ == '__main__':
    sys.exit(main())
