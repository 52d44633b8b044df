# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 param dump`."""

from __future__ import annotations

import argparse

from ros2param.api import (
    add_node_name_argument,
    add_param_arguments,
    get_parameters,
    list_parameters,
    remote_node,
)
from ros2param.verb import VerbExtension


class DumpVerb(VerbExtension):
    """Show all of the parameters of a node in a YAML format."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the name of the node.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 param dump`; unused.

        """
        add_param_arguments(parser)
        add_node_name_argument(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print all parameters of the node as a YAML parameter file.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        """
        from ros2cli.messages.text import plain_to_yaml
        from ros2param.api.file import nest, PARAMETERS
        from ros2param.api.values import to_plain_value, TYPES

        with remote_node(args) as (node, name):
            names = list_parameters(node, name)
            values = get_parameters(node, name, names)
        known = {
            parameter: to_plain_value(value)
            for parameter, value in zip(names, values)
            if value.type in TYPES
        }
        print(plain_to_yaml({name: {PARAMETERS: nest(known)}}))
        return None
