# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 multicast receive`."""

from __future__ import annotations

import argparse

from ros2multicast.api import add_group_arguments, receive
from ros2multicast.verb import VerbExtension


class ReceiveVerb(VerbExtension):
    """Receive a single UDP multicast packet."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the group and the port.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 multicast receive`; unused.

        """
        add_group_arguments(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Wait for a packet and print it with its sender.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        Raises
        ------
        RuntimeError
            The group cannot be joined, or the port is taken.

        """
        print('Waiting for UDP multicast datagram...')
        data, (host, port) = receive(group=args.group, port=args.port)
        print(f'Received from {host}:{port}: {data.decode("utf-8", "backslashreplace")!r}')
        return None
