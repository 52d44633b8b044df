# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 doctor hello`."""

from __future__ import annotations

import argparse

from ros2cli.argument_types import positive_number
from ros2cli.node.arguments import add_node_arguments
from ros2doctor.verb import VerbExtension
from ros2multicast.api.arguments import time_to_live


class HelloVerb(VerbExtension):
    """Check network connectivity between multiple hosts."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the topic, the periods and the TTL.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 doctor hello`; unused.

        """
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
        add(
            '--ttl',
            metavar='N',
            type=time_to_live,
            default=1,
            help='Hops of multicast; 1 stays in the local network (%(default)s)',
        )
        add('-1', '--once', action='store_true', help='Print one table and end')

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Exchange greetings with hosts that run the same command, and print who was heard.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        """
        from ros2cli.node.direct import DirectNode
        from ros2doctor.api.greeting import greet

        with DirectNode(args) as node:
            greet(node, args)
        return None
