# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 multicast receive`."""

from __future__ import annotations

import argparse

from ros2multicast.api.arguments import add_group_arguments
from ros2multicast.verb import VerbExtension


class ReceiveVerb(VerbExtension):
    """Receive a single UDP multicast packet."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """Add the group and the port."""
        add_group_arguments(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """Wait for a packet and print it with its sender."""
        from ros2multicast.api import receive

        print('Waiting for UDP multicast datagram...')
        data, (host, port) = receive(group=args.group, port=args.port)
        print(f'Received from {host}:{port}: {data.decode("utf-8", "backslashreplace")!r}')
        return None
