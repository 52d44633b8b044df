# SPDX-License-Identifier: Apache-2.0
"""The hidden commands `ros2 extension_points` and `ros2 extensions`."""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence

from ros2cli.cli import COMMAND_GROUP, COMMANDS
from ros2cli.command import CommandExtension
from ros2cli.entry import entries_of_group, Entry

Table = Mapping[str, Entry]


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
        for group, own in extension_points().items():
            print(group)
            if args.verbose:
                count = len(extensions(group, own))
                print(f'  {len(own)} here, {count - len(own)} from other packages')
        return None


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
        for group, own in extension_points().items():
            print(group)
            for name, entry in extensions(group, own).items():
                _print_extension(name, entry, args)
        return None


def _print_extension(name: str, entry: Entry, args: argparse.Namespace) -> None:
    problem = _why_not(entry)
    if problem and not args.all:
        return
    print(f'  - {name}: {problem}' if problem else f'  {name}')
    if args.verbose:
        print(f'    {entry.target}')


def extension_points() -> dict[str, Table]:
    """Return the groups of entry points that are searched, sorted, with their own entries."""
    groups: dict[str, Table] = {COMMAND_GROUP: COMMANDS}
    for entry in COMMANDS.values():
        groups.update(entry.create().extension_points())
    return dict(sorted(groups.items()))


def extensions(group: str, own: Table) -> dict[str, Entry]:
    """
    Return the extensions of a group of entry points, sorted by name.

    Parameters
    ----------
    group
        The name of the group.
    own
        The entries of the static table, which override entry points of the same name.

    """
    return dict(sorted({**entries_of_group(group), **own}.items()))


def _why_not(entry: Entry) -> str:
    """
    Check whether an extension can be imported and created; return the reason if not, or ''.

    Parameters
    ----------
    entry
        The extension.

    """
    try:
        entry.create()
    except Exception as error:
        return f'{type(error).__name__}: {error}'
    return ''
