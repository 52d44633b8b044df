# SPDX-License-Identifier: Apache-2.0
"""Options and arguments shared by the verbs of `ros2 param`."""

from __future__ import annotations

import argparse

from ros2cli.argument_types import positive_number
from ros2cli.node.arguments import add_hidden_nodes_argument, add_strategy_arguments

DEFAULT_TIMEOUT_S = 1.0


def add_param_arguments(parser: argparse.ArgumentParser) -> None:
    """
    Add the options for discovery, hidden nodes and the timeout.

    Parameters
    ----------
    parser
        The parser of the verb.

    """
    add_strategy_arguments(parser)
    add_hidden_nodes_argument(parser)
    parser.add_argument(
        '--timeout',
        metavar='N',
        type=positive_number,
        default=DEFAULT_TIMEOUT_S,
        help='Wait for N seconds until node becomes available (default: %(default)s)',
    )


def add_node_name_argument(parser: argparse.ArgumentParser, *, optional: bool = False) -> None:
    """
    Add the positional argument `node_name`.

    Parameters
    ----------
    parser
        The parser of the verb.
    optional
        Whether it may be left out; `node_name` is None then.

    """
    parser.add_argument('node_name', nargs='?' if optional else None, help='Name of the ROS node')


def add_parameter_name_argument(parser: argparse.ArgumentParser) -> None:
    """
    Add the positional argument `parameter_name`.

    Parameters
    ----------
    parser
        The parser of the verb.

    """
    parser.add_argument('parameter_name', help='Name of the parameter')
