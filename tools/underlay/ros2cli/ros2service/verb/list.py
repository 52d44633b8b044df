# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 service list`."""

from __future__ import annotations

import argparse

from ros2cli.node.arguments import add_strategy_arguments
from ros2service.verb import VerbExtension


class ListVerb(VerbExtension):
    """Output a list of available services."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """Add what to show of each service."""
        add_strategy_arguments(parser)
        parser.add_argument(
            '-t', '--show-types', action='store_true', help='Additionally show the service type'
        )
        parser.add_argument(
            '-c',
            '--count-services',
            action='store_true',
            help='Only display the number of services discovered',
        )
        parser.add_argument(
            '--include-hidden-services',
            action='store_true',
            default=argparse.SUPPRESS,
            help='Consider hidden services as well',
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """Print the services, or their count."""
        from ros2cli.node.strategy import NodeStrategy
        from ros2service.api import get_service_names_and_types

        with NodeStrategy(args) as node:
            services = get_service_names_and_types(
                node=node, include_hidden_services=args.include_hidden_services
            )
        if args.count_services:
            print(len(services))
            return None
        for name, types in services:
            print(f'{name} [{", ".join(types)}]' if args.show_types else name)
        return None
