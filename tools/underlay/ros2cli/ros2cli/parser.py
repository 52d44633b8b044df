# SPDX-License-Identifier: Apache-2.0
"""The argument parser of the command line: quick to build, and it takes words in any order."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
import os
import sys
from typing import Any

from ros2cli.option_order import options_first

DEFAULT_COLUMNS = 80
MARGIN = 2


class HelpFormatter(argparse.RawDescriptionHelpFormatter):
    """A formatter that knows the width itself: argparse would import shutil for that."""

    def __init__(self, prog: str) -> None:
        """Use the width of the terminal."""
        super().__init__(prog, width=_columns() - MARGIN)


class Parser(argparse.ArgumentParser):
    """A parser in which options may stand anywhere, and numbers may be negative."""

    def __init__(self, *args: Any, **options: Any) -> None:
        """Keep descriptions as they are, unless another formatter is wanted."""
        super().__init__(*args, **{'formatter_class': HelpFormatter, **options})

    def parse_known_args(  # type: ignore[override]
        self, args: Sequence[str] | None = None, namespace: Any = None
    ) -> Any:
        """Parse the words, whatever their order is."""
        words = sys.argv[1:] if args is None else list(args)
        if self._takes_any_order():
            words = options_first(words, self._option_string_actions)
        return super().parse_known_args(words, namespace)

    def print_help(self, file: Any = None) -> None:
        """Print the help like any other output; argparse hides that it cannot be written."""
        print(self.format_help(), end='', file=file or sys.stdout)

    def _takes_any_order(self) -> bool:
        """Tell if there are positionals, and none takes all words, whatever they look like."""
        kinds = [action.nargs for action in self._actions if not action.option_strings]
        return bool(kinds) and not {argparse.PARSER, argparse.REMAINDER}.intersection(kinds)


def _columns() -> int:
    """Return the width of the terminal, as the variable COLUMNS or the terminal has it."""
    columns = os.environ.get('COLUMNS', '')
    if columns.isdecimal() and int(columns):
        return int(columns)
    try:
        return os.get_terminal_size(sys.__stdout__.fileno()).columns  # type: ignore[union-attr]
    except (AttributeError, ValueError, OSError):
        return DEFAULT_COLUMNS
