# SPDX-License-Identifier: Apache-2.0
"""The node whose parameters a command accesses: its arguments, and how it is found."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, TYPE_CHECKING

from ros2cli.arguments import add_hidden_nodes_argument, add_strategy_arguments, positive_number
from ros2cli.waiting import Patience
from ros2node.api import find_node
from ros2param.api import LIST_SERVICE

if TYPE_CHECKING:
    from ros2cli.graph.graph import Graph

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


@contextmanager
def remote_node(args: argparse.Namespace) -> Iterator[tuple[Any, str]]:
    """
    Create a node for this command and find the one whose parameters it accesses.

    Parameters
    ----------
    args : argparse.Namespace
        The parsed command line, with `node_name` and `timeout` (s).

    Yields
    ------
    tuple of DirectNode and str
        The node of this command, and the full name of the other one.

    Raises
    ------
    RuntimeError
        The other node does not appear in time, or has no parameter services.

    """
    from ros2cli.node.direct import DirectNode

    with DirectNode(args) as node:
        name = find_node(node.watch, args.node_name, args.timeout)
        _require_services(node, name, args.timeout)
        yield node, name


def _require_services(node: Any, name: str, timeout_s: float) -> None:
    def has_services(graph: Graph) -> bool:
        return bool(graph.count_services(f'{name}{LIST_SERVICE}'))

    patience = Patience(f"the parameter services of '{name}'")
    if not node.watch.wait_for(has_services, patience, timeout_s):
        raise RuntimeError(
            f"The node '{name}' has no parameter services: it was started with "
            'start_parameter_services=False'
        )
