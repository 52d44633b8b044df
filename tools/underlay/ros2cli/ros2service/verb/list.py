# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 service list`."""

from __future__ import annotations

import argparse

from ros2cli.arguments import (
    add_count_argument,
    add_hidden_argument,
    add_strategy_arguments,
    add_types_argument,
)
from ros2cli.names import print_names, with_types
from ros2service.verb import VerbExtension


class ListVerb(VerbExtension):
    """Output a list of available services."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the options for types, for hidden services and for printing only a count.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 service list`; unused.

        """
        add_strategy_arguments(parser)
        add_types_argument(parser, 'service')
        add_count_argument(parser, 'services')
        add_hidden_argument(parser, 'services')

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the names of the services, with their types if wanted, or their number.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        """
        from ros2cli.node.strategy import NodeStrategy
        from ros2service.api import get_service_names_and_types

        with NodeStrategy(args) as node:
            services = get_service_names_and_types(
                node=node, include_hidden_services=args.include_hidden_services
            )
        lines = with_types(services, show_types=args.show_types)
        print_names(lines, only_count=args.count_services)
        return None
