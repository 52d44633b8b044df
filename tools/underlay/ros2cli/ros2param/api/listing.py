# SPDX-License-Identifier: Apache-2.0
"""Print the names of parameters."""

from __future__ import annotations

import argparse
import sys
from typing import Any

from ros2cli.node.lookup import nodes_with_service
from ros2param.api import describe_parameters, list_parameters, LIST_SERVICE, LIST_TYPE
from ros2param.api.values import type_name

ANSWER_TIMEOUT_S = 5.0


def print_all(node: Any, args: argparse.Namespace) -> None:
    """
    Print the parameters of all nodes, each node's below its name.

    A node that does not respond within 5 s is reported on stderr and skipped.

    Parameters
    ----------
    node
        The `DirectNode` that calls.
    args : argparse.Namespace
        The parsed command line of `ros2 param list`.

    """
    names = nodes_with_service(
        node.graph, LIST_SERVICE, LIST_TYPE, include_hidden_nodes=args.include_hidden_nodes
    )
    for name in names:
        try:
            lines = _lines(node, name, args, ANSWER_TIMEOUT_S)
        except RuntimeError as error:
            print(f"The parameters of '{name}' are not listed: {error}", file=sys.stderr)
            continue
        print(f'{name}:')
        for line in lines:
            print(line)


def print_one(node: Any, name: str, args: argparse.Namespace) -> None:
    """
    Print the parameters of one node.

    Parameters
    ----------
    node
        The `DirectNode` that calls.
    name
        Full name of the node.
    args : argparse.Namespace
        The parsed command line of `ros2 param list`.

    """
    for line in _lines(node, name, args, float('inf')):
        print(line)


def _lines(node: Any, name: str, args: argparse.Namespace, timeout_s: float) -> list[str]:
    found = list_parameters(node, name, args.param_prefixes, timeout_s)
    chosen = [each for each in found if not args.filter or args.filter.search(each)]
    if not args.param_type:
        return [f'  {each}' for each in chosen]
    types = {each.name: each.type for each in describe_parameters(node, name, chosen)}
    return [f'  {each} (type: {type_name(types.get(each, 0))})' for each in chosen]
