# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 param describe`."""

from __future__ import annotations

import argparse
import sys

from ros2param.api.arguments import add_node_name_argument, add_param_arguments
from ros2param.verb import VerbExtension


class DescribeVerb(VerbExtension):
    """Show descriptive information about declared parameters."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the names of the node and the parameters.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 param describe`; unused.

        """
        add_param_arguments(parser)
        add_node_name_argument(parser)
        parser.add_argument('parameter_names', nargs='+', help='Names of the parameters')

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the descriptor of each parameter; unknown ones are reported on stderr.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        """
        from ros2param.api import (
            describe_parameters,
            list_parameters,
            unknown_parameter_text,
        )
        from ros2param.api.description import description_lines
        from ros2param.api.remote import remote_node

        with remote_node(args) as (node, name):
            known = set(list_parameters(node, name))
            wanted = [each for each in args.parameter_names if each in known]
            descriptors = describe_parameters(node, name, wanted) if wanted else []
        for descriptor in descriptors:
            print('\n'.join(description_lines(descriptor)))
        for each in args.parameter_names:
            if each not in known:
                print(unknown_parameter_text(name, each, known), file=sys.stderr)
        return None
