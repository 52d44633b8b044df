# SPDX-License-Identifier: Apache-2.0
"""The hidden command `ros2 extension_points`."""

from __future__ import annotations

import argparse
from collections.abc import Sequence

from ros2cli.command import CommandExtension


class ExtensionPointsCommand(CommandExtension):
    """List extension points."""

    def add_arguments(
        self, parser: argparse.ArgumentParser, cli_name: str, *, argv: Sequence[str] | None = None
    ) -> None:
        """
        Add the option for details.

        Parameters
        ----------
        parser, cli_name, argv
            As for `CommandExtension.add_arguments`.

        """
        parser.add_argument(
            '-v',
            '--verbose',
            action='store_true',
            help='Show how many extensions there are, here and in other packages',
        )

    def main(
        self, *, parser: argparse.ArgumentParser, args: argparse.Namespace
    ) -> int | str | None:
        """
        Print the groups of entry points, one per line.

        Parameters
        ----------
        parser, args
            As for `CommandExtension.main`.

        """
        from ros2cli.extension_points import extension_points, extensions

        for group, own in extension_points().items():
            print(group)
            if args.verbose:
                count = len(extensions(group, own))
                print(f'  {len(own)} here, {count - len(own)} of other packages')
        return None
