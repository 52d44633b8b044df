# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 multicast send`."""

from __future__ import annotations

import argparse

from ros2multicast.api import add_group_arguments, DEFAULT_TTL, send, time_to_live
from ros2multicast.verb import VerbExtension

GREETING = b'Hello World!'


class SendVerb(VerbExtension):
    """Send a single UDP multicast packet."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the group, the port and the TTL.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 multicast send`; unused.

        """
        add_group_arguments(parser)
        parser.add_argument(
            '-t',
            '--ttl',
            type=time_to_live,
            default=DEFAULT_TTL,
            help='The multicast TTL (default: %(default)s)',
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Send a greeting to the group.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        Raises
        ------
        RuntimeError
            The packet cannot be sent.

        """
        print('Sending one UDP multicast datagram...')
        send(GREETING, group=args.group, port=args.port, ttl=args.ttl)
        return None
