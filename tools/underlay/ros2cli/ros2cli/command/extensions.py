# SPDX-License-Identifier: Apache-2.0
"""The hidden command `ros2 extensions`."""

from __future__ import annotations

import argparse
from collections.abc import Sequence

from ros2cli.command import CommandExtension
from ros2cli.entry import Entry


class ExtensionsCommand(CommandExtension):
    """List extensions."""

    def add_arguments(
        self, parser: argparse.ArgumentParser, cli_name: str, *, argv: Sequence[str] | None = None
    ) -> None:
        """
        Add the options for which extensions to show and for details.

        Parameters
        ----------
        parser, cli_name, argv
            As for `CommandExtension.add_arguments`.

        """
        parser.add_argument(
            '-a',
            '--all',
            action='store_true',
            help='Also show extensions which cannot be used, and why',
        )
        parser.add_argument(
            '-v', '--verbose', action='store_true', help='Show where each extension is defined'
        )

    def main(
        self, *, parser: argparse.ArgumentParser, args: argparse.Namespace
    ) -> int | str | None:
        """
        Print the groups of entry points, each with its extensions below it.

        Parameters
        ----------
        parser, args
            As for `CommandExtension.main`.

        """
        from ros2cli.extension_points import extension_points, extensions

        for group, own in extension_points().items():
            print(group)
            for name, entry in extensions(group, own).items():
                _print_extension(name, entry, args)
        return None


def _print_extension(name: str, entry: Entry, args: argparse.Namespace) -> None:
    from ros2cli.extension_points import why_not

    problem = why_not(entry)
    if problem and not args.all:
        return
    print(f'  - {name}: {problem}' if problem else f'  {name}')
    if args.verbose:
        print(f'    {entry.target}')
