# SPDX-License-Identifier: Apache-2.0
"""The node whose parameters a command accesses."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from ros2cli.graph.graph import Graph
from ros2cli.node.direct import DirectNode
from ros2cli.node.lookup import find_node
from ros2cli.patience import Patience
from ros2param.api import LIST_SERVICE


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
