# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 service find`."""

from __future__ import annotations

import argparse

from ros2cli.arguments import add_count_argument, add_hidden_argument, add_strategy_arguments
from ros2cli.names import print_names
from ros2service.verb import VerbExtension


class FindVerb(VerbExtension):
    """Output a list of available services of a given type."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the service type and the options for hidden services and for printing only a count.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 service find`; unused.

        """
        add_strategy_arguments(parser)
        parser.add_argument(
            'service_type',
            help="Name of the ROS service type to filter for (e.g. 'std_srvs/srv/Empty')",
        )
        add_count_argument(parser, 'services')
        add_hidden_argument(parser, 'services')

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the services of the type, or their number.

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
        names = [name for name, types in services if args.service_type in types]
        print_names(names, only_count=args.count_services)
        return None
