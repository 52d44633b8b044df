# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 param get`."""

from __future__ import annotations

import argparse

from ros2param.api import (
    add_node_name_argument,
    add_param_arguments,
    add_parameter_name_argument,
    get_parameters,
    remote_node,
    unknown_parameter_hint,
)
from ros2param.verb import VerbExtension


class GetVerb(VerbExtension):
    """Get parameter."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the names of the node and the parameter, and the option to hide the type.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 param get`; unused.

        """
        add_param_arguments(parser)
        add_node_name_argument(parser)
        add_parameter_name_argument(parser)
        parser.add_argument('--hide-type', action='store_true', help='Hide the type information')

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the value of the parameter, with or without its type.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        Returns
        -------
        str or None
            The error message if the parameter is not set.

        """
        from ros2param.api.values import to_plain_value, TYPES

        with remote_node(args) as (node, name):
            value = get_parameters(node, name, [args.parameter_name])[0]
            if value.type not in TYPES:
                hint = unknown_parameter_hint(node, name, args.parameter_name)
                return '\n'.join(['Parameter not set', hint]).rstrip()
        plain = to_plain_value(value)
        print(plain if args.hide_type else f'{TYPES[value.type].label} {plain}')
        return None
