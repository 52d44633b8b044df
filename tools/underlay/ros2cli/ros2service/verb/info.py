# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 service info`."""

from __future__ import annotations

import argparse
from typing import Any

from ros2cli.arguments import add_strategy_arguments
from ros2service.verb import VerbExtension


class InfoVerb(VerbExtension):
    """Print information about a service."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the name of the service.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 service info`; unused.

        """
        add_strategy_arguments(parser)
        parser.add_argument(
            'service_name', help="Name of the ROS service to get info (e.g. '/add_two_ints')"
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the type of the service and the numbers of its clients and servers.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        Returns
        -------
        str or None
            The error message if the service is unknown.

        """
        from ros2cli.node.strategy import NodeStrategy
        from ros2service.api import get_service_types, unknown_service_text

        def find(graph: Any) -> list[str]:
            return get_service_types(graph, args.service_name)

        with NodeStrategy(args, find) as node:
            types = find(node)
            if not types:
                return unknown_service_text(node, args.service_name)
            clients = node.count_clients(args.service_name)
            services = node.count_services(args.service_name)
        print('Type:', types[0] if len(types) == 1 else types)
        print('Clients count:', clients)
        print('Services count:', services)
        return None
