# SPDX-License-Identifier: Apache-2.0
"""What `talker_qos` and `listener_qos` share: the command line, and the end after N messages."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from typing import Any

from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.task import Future
from tf2_ros.program import run, spin

__all__ = ['Countdown', 'describe', 'parse_options', 'run_until_counted']

RELIABLE = QoSProfile(depth=10, reliability=ReliabilityPolicy.RELIABLE)
BEST_EFFORT = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)


class Countdown:
    """
    Counter of messages that a coroutine can wait for.

    Parameters
    ----------
    count
        The number of messages; without one, the wait never ends.

    """

    def __init__(self, count: int | None) -> None:
        self._left = count
        self._end: Future[None] = Future()

    @property
    def is_over(self) -> bool:
        """Whether the last message has been counted."""
        return self._left == 0

    def count(self) -> None:
        """Count a message."""
        if self._left is not None:
            self._left -= 1
            if self._left == 0:
                self._end.set_result(None)

    async def wait(self) -> None:
        """Wait for the last message."""
        await self._end


def describe(qos_profile: QoSProfile) -> str:
    """
    Name the reliability of a profile, for the log.

    Parameters
    ----------
    qos_profile
        The profile.

    """
    is_reliable = qos_profile.reliability == ReliabilityPolicy.RELIABLE
    return 'Reliable' if is_reliable else 'Best effort'


def parse_options(words: list[str], program: str, done: str) -> tuple[QoSProfile, int]:
    """
    Parse the command line; exit with a message if it is wrong.

    Parameters
    ----------
    words
        The arguments, without those of ROS.
    program
        The name of the executable.
    done
        What happens to each message: published or received.

    Returns
    -------
    tuple
        The QoS profile, and the number of messages after which the program ends.

    """
    parser = argparse.ArgumentParser(
        prog=program,
        description=f'A node whose messages on the topic chatter are {done} by best effort, '
        'or reliably.',
    )
    parser.add_argument('--reliable', action='store_true', help='reliable instead of best effort')
    parser.add_argument(
        '-n',
        '--number_of_cycles',
        type=_count,
        default=20,
        metavar='N',
        help=f'end when N messages were {done} (default: 20)',
    )
    found = parser.parse_args(words)
    return (RELIABLE if found.reliable else BEST_EFFORT), found.number_of_cycles


def run_until_counted(
    make_node: Callable[[QoSProfile, int], Any],
    program: str,
    done: str,
    argv: Sequence[str] | None,
) -> int:
    """
    Run a node until it has counted its messages; return the exit status.

    Parameters
    ----------
    make_node
        Creates the node from the quality of service and the number of messages.
    program, done
        As for `parse_options`.
    argv : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """

    def work(options: tuple[QoSProfile, int]) -> None:
        node = make_node(*options)
        spin(node, task=node.countdown.wait)
        node.destroy_node()

    return run(lambda words: parse_options(words, program, done), work, argv)


def _count(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f'{text!r} is not a number of messages: give 1 or more')
    return int(text)
