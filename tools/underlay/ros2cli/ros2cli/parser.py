# SPDX-License-Identifier: Apache-2.0
"""Argument parser and help formatter of all commands."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
import os
import sys

from ros2cli.option_order import options_first
from ros2cli.suggest import did_you_mean

TYPE_CHECKING = False

if TYPE_CHECKING:
    from typing import Any  # noqa: I300

DEFAULT_WIDTH = 80
MARGIN = 2
YAML_EXAMPLE = '"{data: [1, 2]}"'


class Parser(argparse.ArgumentParser):
    """
    Argument parser with options in any position, negative numbers, and helpful errors.

    Parameters
    ----------
    **options
        Options of an argparse parser; descriptions are printed verbatim by default.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__(**{'formatter_class': HelpFormatter, **options})

    def parse_args(  # type: ignore[override]
        self, args: Sequence[str] | None = None, namespace: Any = None
    ) -> argparse.Namespace:
        """
        Parse a command line; unrecognized arguments are an error with advice.

        Parameters
        ----------
        args : Sequence[str] | None
            The arguments; those of this process if None.
        namespace
            The namespace to add the result to; a new one if None.

        Raises
        ------
        SystemExit
            The command line is invalid, or requests help.

        """
        found, rest = self.parse_known_args(args, namespace)
        if rest:
            advice = found._parser_of_rest.advice(rest)
            self.error('\n'.join([f'unrecognized arguments: {" ".join(rest)}', advice]).rstrip())
        return found

    def parse_known_args(  # type: ignore[override]
        self, args: Sequence[str] | None = None, namespace: Any = None
    ) -> tuple[argparse.Namespace, list[str]]:
        """
        Parse the recognized arguments of a command line.

        Parameters
        ----------
        args, namespace
            As for `parse_args`.

        Returns
        -------
        tuple of argparse.Namespace and list of str
            The result, and the remaining arguments; `_parser_of_rest` is the innermost parser of
            these.

        Raises
        ------
        SystemExit
            The command line is invalid, or requests help.

        """
        words = sys.argv[1:] if args is None else list(args)
        if self._takes_any_order():
            words = options_first(words, self._option_string_actions)
        found, rest = super().parse_known_args(words, namespace)
        if rest and not hasattr(found, '_parser_of_rest'):
            found._parser_of_rest = self
        return found, rest

    def advice(self, words: list[str]) -> str:
        """
        Return a suggestion for arguments that this parser does not recognize, or ''.

        Parameters
        ----------
        words
            The unrecognized arguments, at least one.

        """
        if any(word.endswith(('}', ']')) for word in words):
            return f'A value with spaces needs quotes, as in {YAML_EXAMPLE}'
        option = words[0].partition('=')[0]
        return did_you_mean(option, self._option_string_actions) if option[:2] == '--' else ''

    def print_help(self, file: Any = None) -> None:
        """
        Print the help like any other output; argparse would hide write errors.

        Parameters
        ----------
        file
            The stream to print to; stdout if None.

        """
        print(self.format_help(), end='', file=file or sys.stdout)

    def _takes_any_order(self) -> bool:
        """Whether there are positionals, and none consumes all remaining arguments."""
        kinds = [action.nargs for action in self._actions if not action.option_strings]
        return bool(kinds) and not {argparse.PARSER, argparse.REMAINDER}.intersection(kinds)


class HelpFormatter(argparse.RawDescriptionHelpFormatter):
    """
    Help formatter with the width of the terminal.

    argparse creates a formatter for each argument, and would import shutil, with all its
    compression libraries, to determine the width.

    Parameters
    ----------
    prog
        The name of the program.
    **options
        Options of an argparse formatter.

    """

    def __init__(self, prog: str, **options: Any) -> None:
        super().__init__(prog, **{'width': terminal_width() - MARGIN, **options})


def terminal_width() -> int:
    """Return the number of columns: COLUMNS if it is set, else that of the terminal."""
    columns = os.environ.get('COLUMNS', '')
    if columns.isdecimal() and int(columns):
        return int(columns)
    try:
        return os.get_terminal_size(1).columns or DEFAULT_WIDTH
    except OSError:
        return DEFAULT_WIDTH
