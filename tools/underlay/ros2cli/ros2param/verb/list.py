# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 param list`."""

from __future__ import annotations

import argparse
import sys
from typing import Any

from ros2cli.arguments import regular_expression
from ros2node.api import nodes_with_service
from ros2param.api import (
    add_node_name_argument,
    add_param_arguments,
    describe_parameters,
    list_parameters,
    LIST_SERVICE,
    LIST_TYPE,
    remote_node,
)
from ros2param.verb import VerbExtension

ANSWER_TIMEOUT_S = 5.0


class ListVerb(VerbExtension):
    """Output a list of available parameters."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the name of the node and the options that filter the parameters.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 param list`; unused.

        """
        add_param_arguments(parser)
        add_node_name_argument(parser, optional=True)
        _add_list_arguments(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the parameters of one node, or those of all nodes below their names.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        """
        from ros2cli.node.direct import DirectNode

        if args.node_name is None:
            with DirectNode(args) as node:
                _print_all(node, args)
            return None
        with remote_node(args) as (node, name):
            _print_one(node, name, args)
        return None


def _add_list_arguments(parser: argparse.ArgumentParser) -> None:
    """
    Add the options that filter the parameters and show their types.

    Parameters
    ----------
    parser
        The parser of the verb.

    """
    parser.add_argument(
        '--param-prefixes',
        nargs='+',
        default=[],
        help='Only list parameters with the provided prefixes',
    )
    parser.add_argument(
        '--param-type', action='store_true', help='Print parameter types with parameter names'
    )
    parser.add_argument(
        '--filter',
        type=regular_expression,
        metavar='REGEX',
        help='Only list parameters matching the provided regex',
    )


def _print_all(node: Any, args: argparse.Namespace) -> None:
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
            print(f"Could not list the parameters of '{name}': {error}", file=sys.stderr)
            continue
        print(f'{name}:')
        for line in lines:
            print(line)


def _print_one(node: Any, name: str, args: argparse.Namespace) -> None:
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
    from ros2param.api.values import type_name

    found = list_parameters(node, name, args.param_prefixes, timeout_s)
    chosen = [each for each in found if not args.filter or args.filter.search(each)]
    if not args.param_type:
        return [f'  {each}' for each in chosen]
    types = {each.name: each.type for each in describe_parameters(node, name, chosen)}
    return [f'  {each} (type: {type_name(types.get(each, 0))})' for each in chosen]
