# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 doctor hello`."""

from __future__ import annotations

import argparse

from ros2cli.argument_types import positive_number
from ros2cli.node.arguments import add_node_arguments
from ros2doctor.verb import VerbExtension


class HelloVerb(VerbExtension):
    """Check network connectivity between multiple hosts."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """Add the topic, the periods and the reach."""
        add_node_arguments(parser)
        add = parser.add_argument
        add('-t', '--topic', default='/canyouhearme', help='Topic to greet on (%(default)s)')
        add(
            '-ep',
            '--emit-period',
            metavar='SECONDS',
            type=positive_number,
            default=0.1,
            help='Time between two greetings (%(default)s)',
        )
        add(
            '-pp',
            '--print-period',
            metavar='SECONDS',
            type=positive_number,
            default=1.0,
            help='Time between two tables (%(default)s)',
        )
        add('--ttl', metavar='N', type=int, default=1, help='Routers that multicast may pass')
        add('-1', '--once', action='store_true', help='Print one table and end')

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """Greet the hosts that do the same, and print who was heard."""
        from ros2cli.node.direct import DirectNode
        from ros2doctor.api.greeting import greet

        with DirectNode(args) as node:
            greet(node, args)
        return None
