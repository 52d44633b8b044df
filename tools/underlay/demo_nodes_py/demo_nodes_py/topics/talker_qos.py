# SPDX-License-Identifier: Apache-2.0
"""A talker whose quality of service is chosen on the command line."""

from __future__ import annotations

from collections.abc import Sequence
import sys

from demo_nodes_py.topics.qos_program import Countdown, describe, run_until_counted
from demo_nodes_py.topics.talker import Talker
from rclpy.qos import QoSProfile

__all__ = ['TalkerQos', 'main']


class TalkerQos(Talker):
    """
    Publishes messages of the topic `chatter` with a given quality of service.

    Parameters
    ----------
    qos_profile
        The quality of service.
    count
        The number of messages that `countdown` counts.

    """

    def __init__(self, qos_profile: QoSProfile, count: int | None = None) -> None:
        super().__init__('talker_qos', qos_profile)
        self.countdown = Countdown(count)
        self.get_logger().info(f'{describe(qos_profile)} talker')

    def timer_callback(self) -> None:
        """Publish the next message, and count it."""
        super().timer_callback()
        self.countdown.count()


def main(argv: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    argv : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_until_counted(TalkerQos, 'talker_qos', 'published', argv)


if __name__ == '__main__':
    sys.exit(main())
