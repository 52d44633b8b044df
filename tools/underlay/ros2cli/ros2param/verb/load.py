# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 param load`."""

from __future__ import annotations

import argparse
import sys
from typing import Any

from ros2param.api import (
    add_node_name_argument,
    add_param_arguments,
    refusal_hint,
    remote_node,
    set_parameter,
)
from ros2param.verb import VerbExtension


class LoadVerb(VerbExtension):
    """Load parameter file for a node."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the name of the node, the parameter file and the option for wildcards.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 param load`; unused.

        """
        add_param_arguments(parser)
        add_node_name_argument(parser)
        parser.add_argument('parameter_file', help='Parameter file')
        parser.add_argument(
            '--no-use-wildcard',
            action='store_true',
            help="Do not load parameters in the '/**' namespace into the node",
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Set the parameters of the file one by one and print the node's response to each.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        """
        from ros2param.api.file import read_parameters

        with remote_node(args) as (node, name):
            values = read_parameters(
                args.parameter_file, name, use_wildcard=not args.no_use_wildcard
            )
            for parameter, value in values.items():
                _set(node, name, parameter, value)
        return None


def _set(node: Any, node_name: str, parameter: str, value: Any) -> None:
    result = set_parameter(node, node_name, parameter, value)
    reason = f': {result.reason}' if result.reason else ''
    if result.successful:
        print(f'Set parameter {parameter} successful{reason}')
        return
    hint = refusal_hint(node, node_name, parameter, value, reason)
    print(f'Set parameter {parameter} failed{reason}\n{hint}'.rstrip(), file=sys.stderr)
