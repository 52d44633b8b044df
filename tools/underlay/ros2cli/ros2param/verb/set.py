# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 param set`."""

from __future__ import annotations

import argparse
import sys

from ros2param.api import (
    add_node_name_argument,
    add_param_arguments,
    add_parameter_name_argument,
    refusal_hint,
    remote_node,
    set_parameter,
)
from ros2param.verb import VerbExtension


class SetVerb(VerbExtension):
    """Set parameter."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the names of the node and the parameter, and the value.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 param set`; unused.

        """
        add_param_arguments(parser)
        add_node_name_argument(parser)
        add_parameter_name_argument(parser)
        parser.add_argument('value', help='Value of the parameter, in YAML')

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Set the parameter and print the node's response.

        A rejection goes to stderr, but the exit status stays 0.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        """
        from ros2param.api.values import parse_value

        value = parse_value(args.value)
        with remote_node(args) as (node, name):
            result = set_parameter(node, name, args.parameter_name, value)
            reason = f': {result.reason}' if result.reason else ''
            if result.successful:
                print(f'Set parameter successful{reason}')
                return None
            hint = refusal_hint(node, name, args.parameter_name, value, reason)
        print(f'Setting parameter failed{reason}\n{hint}'.rstrip(), file=sys.stderr)
        return None
