# SPDX-License-Identifier: Apache-2.0
"""Options shared by all verbs with a node; importing this does not import rclpy."""

from __future__ import annotations

import argparse

from ros2cli.argument_types import positive_number
from ros2cli.graph import DEFAULT_SPIN_TIME_S


def add_node_arguments(parser: argparse.ArgumentParser) -> None:
    """
    Add the options for discovery and simulated time.

    Parameters
    ----------
    parser
        The parser of the verb.

    """
    parser.add_argument(
        '--spin-time',
        type=positive_number,
        default=DEFAULT_SPIN_TIME_S,
        metavar='SECONDS',
        help='time to wait for nodes on other machines, and for names that are not there yet '
        '(default: %(default)s)',
    )
    parser.add_argument(
        '-s', '--use-sim-time', action='store_true', help='use the time of the topic /clock'
    )


def add_strategy_arguments(parser: argparse.ArgumentParser) -> None:
    """
    Add the options of verbs that read the graph.

    Parameters
    ----------
    parser
        The parser of the verb.

    """
    add_node_arguments(parser)
    parser.add_argument(
        '--no-daemon',
        action='store_true',
        help='accepted for compatibility: discovery is always direct, there is no daemon',
    )


def add_hidden_nodes_argument(parser: argparse.ArgumentParser) -> None:
    """
    Add the option to consider hidden nodes.

    Parameters
    ----------
    parser
        The parser of the verb.

    """
    parser.add_argument(
        '--include-hidden-nodes', action='store_true', help='Consider hidden nodes as well'
    )
