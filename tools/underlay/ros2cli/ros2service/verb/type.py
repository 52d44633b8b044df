# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 service type`."""

from __future__ import annotations

import argparse
from typing import Any

from ros2cli.arguments import add_strategy_arguments
from ros2service.verb import VerbExtension


class TypeVerb(VerbExtension):
    """Output a service's type."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the name of the service.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 service type`; unused.

        """
        add_strategy_arguments(parser)
        parser.add_argument(
            'service_name', help="Name of the ROS service to get type (e.g. '/add_two_ints')"
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print all types of the service, one per line.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        Returns
        -------
        int
            The exit status: 1 if the service is unknown.

        """
        from ros2cli.node.strategy import NodeStrategy
        from ros2service.api import get_service_types

        def find(graph: Any) -> list[str]:
            return get_service_types(graph, args.service_name)

        with NodeStrategy(args, find) as node:
            types = find(node)
        for name in types:
            print(name)
        return 0 if types else 1
