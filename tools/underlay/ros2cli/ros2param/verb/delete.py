# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 param delete`."""

from __future__ import annotations

import argparse
import sys

from ros2param.api import (
    add_node_name_argument,
    add_param_arguments,
    add_parameter_name_argument,
    remote_node,
    set_parameter,
    unknown_parameter_hint,
)
from ros2param.verb import VerbExtension


class DeleteVerb(VerbExtension):
    """Delete parameter."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the names of the node and the parameter.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 param delete`; unused.

        """
        add_param_arguments(parser)
        add_node_name_argument(parser)
        add_parameter_name_argument(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Delete the parameter and print the node's response.

        A rejection goes to stderr, but the exit status stays 0.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        """
        from rcl_interfaces.msg import ParameterValue

        with remote_node(args) as (node, name):
            result = set_parameter(node, name, args.parameter_name, ParameterValue())
            reason = f': {result.reason}' if result.reason else ''
            if result.successful:
                print(f'Deleted parameter successfully{reason}')
                return None
            hint = unknown_parameter_hint(node, name, args.parameter_name)
        print(f'Deleting parameter failed{reason}\n{hint}'.rstrip(), file=sys.stderr)
        return None
