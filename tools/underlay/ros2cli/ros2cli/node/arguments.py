# SPDX-License-Identifier: Apache-2.0
"""The options that all verbs with a node share; importing this does not import rclpy."""

from __future__ import annotations

import argparse

from ros2cli.node.discovery import DEFAULT_SPIN_TIME


def add_node_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options for discovery and time."""
    parser.add_argument(
        '--spin-time',
        type=_positive_seconds,
        default=DEFAULT_SPIN_TIME,
        metavar='SECONDS',
        help='time to wait for discovery if no other node answers (default: %(default)s)',
    )
    parser.add_argument(
        '-s', '--use-sim-time', action='store_true', help='use the time of the topic /clock'
    )


def add_strategy_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of verbs that read the graph."""
    add_node_arguments(parser)
    parser.add_argument(
        '--no-daemon',
        action='store_true',
        help='accepted for compatibility: discovery is always direct, there is no daemon',
    )


def _positive_seconds(text: str) -> float:
    value = float(text)
    if not 0.0 < value < float('inf'):
        raise argparse.ArgumentTypeError(f'{text!r} is not a positive number of seconds')
    return value
