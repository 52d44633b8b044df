# SPDX-License-Identifier: Apache-2.0
"""The base classes of all commands."""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence

from ros2cli.entry import add_lazy_subparsers, add_subparsers_on_demand, Entry

__all__ = ['CHOSEN_VERB', 'CommandExtension', 'VerbCommand', 'add_subparsers_on_demand']

CHOSEN_VERB = 'chosen_verb'
"""The attribute of the parsed arguments that is the verb; there is none if none was named."""


class CommandExtension:
    """A command of `ros2`; the first line of a subclass's docstring is its help."""

    NAME: str | None = None
    EXTENSION_POINT_VERSION = '0.1'

    def add_arguments(
        self, parser: argparse.ArgumentParser, cli_name: str, *, argv: Sequence[str] | None = None
    ) -> None:
        """
        Add the command's own arguments to its parser.

        Parameters
        ----------
        parser
            The parser of the command.
        cli_name
            The command line up to the command, such as `ros2 bag`.
        argv
            The arguments after the name of the command; None if they are unknown.

        """

    def extension_points(self) -> Mapping[str, Mapping[str, Entry]]:
        """Return the groups of entry points that extend this command, with their own entries."""
        return {}

    def main(
        self, *, parser: argparse.ArgumentParser, args: argparse.Namespace
    ) -> int | str | None:
        """
        Execute the command.

        A RuntimeError, like a returned str, is printed on stderr and results in status 1.

        Parameters
        ----------
        parser
            The root parser.
        args : argparse.Namespace
            The parsed arguments.

        Returns
        -------
        int or str or None
            The exit status, or an error message for stderr with status 1; None is status 0.

        Raises
        ------
        NotImplementedError
            The subclass does not override it.

        """
        raise NotImplementedError(f'{type(self).__name__} does not implement main()')


class VerbCommand(CommandExtension):
    """A command that consists of verbs, named in a static table."""

    VERBS: Mapping[str, Entry] = {}
    VERB_GROUP = ''

    def add_arguments(
        self, parser: argparse.ArgumentParser, cli_name: str, *, argv: Sequence[str] | None = None
    ) -> None:
        """
        Add a parser for each verb, with arguments only for the one that is called.

        Parameters
        ----------
        parser, cli_name, argv
            As for `CommandExtension.add_arguments`.

        """
        self._parser = parser
        add_lazy_subparsers(
            parser,
            cli_name,
            entries=self.VERBS,
            group=self.VERB_GROUP,
            kind='verb',
            dest=CHOSEN_VERB,
            argv=argv,
        )

    def extension_points(self) -> Mapping[str, Mapping[str, Entry]]:
        """Return the group of entry points for verbs, with this command's verbs."""
        return {self.VERB_GROUP: self.VERBS}

    def main(
        self, *, parser: argparse.ArgumentParser, args: argparse.Namespace
    ) -> int | str | None:
        """
        Execute the chosen verb, or print the help of the command if there is none.

        Parameters
        ----------
        parser, args
            As for `CommandExtension.main`.

        Returns
        -------
        int or str or None
            What the verb returns; 0 after the help.

        """
        verb = getattr(args, CHOSEN_VERB, None)
        if verb is None:
            self._parser.print_help()
            return 0
        status: int | str | None = verb.main(args=args)
        return status
