# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 param list`."""

from __future__ import annotations

import argparse

from ros2param.api.arguments import add_node_name_argument, add_param_arguments
from ros2param.api.list_arguments import add_list_arguments
from ros2param.verb import VerbExtension


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
        add_list_arguments(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the parameters of one node, or those of all nodes below their names.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        """
        from ros2cli.node.direct import DirectNode
        from ros2param.api.listing import print_all, print_one
        from ros2param.api.remote import remote_node

        if args.node_name is None:
            with DirectNode(args) as node:
                print_all(node, args)
            return None
        with remote_node(args) as (node, name):
            print_one(node, name, args)
        return None
