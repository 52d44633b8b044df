# SPDX-License-Identifier: Apache-2.0
"""
Argument parser and help formatter of all commands.

argparse leaves an optional positional empty as soon as an option precedes it, and mistakes
numbers such as -1e3 for options. The parser puts options before other arguments, which rules out
both.
"""

from __future__ import annotations

import argparse
from collections import deque
from collections.abc import Mapping, Sequence
import os
import re
import sys

from ros_environment.suggestions import did_you_mean

TYPE_CHECKING = False

if TYPE_CHECKING:
    from typing import Any  # noqa: I300

DEFAULT_WIDTH = 80
MARGIN = 2
YAML_EXAMPLE = '"{data: [1, 2]}"'
END_OF_OPTIONS = '--'
NEGATIVE_NUMBER = re.compile(r'-((\d+\.?\d*|\.\d+)(e[-+]?\d+)?|\.inf)', re.IGNORECASE)
UNLIMITED = float('inf')
ROS_ARGS = '--ros-args'
PARSER_OF_REST = '_parser_of_rest'  # an attribute of the result that is not an argument

Options = Mapping[str, argparse.Action]


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
            advice = getattr(found, PARSER_OF_REST).advice(rest)
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
            The result, and the remaining arguments; its `PARSER_OF_REST` is the innermost parser
            of these.

        Raises
        ------
        SystemExit
            The command line is invalid, or requests help.

        """
        words = sys.argv[1:] if args is None else list(args)
        ros_args: list[str] = []
        if ROS_ARGS in self._option_string_actions:
            words, ros_args = without_ros_args(words)
        if self._takes_any_order():
            words = options_first(words, self._option_string_actions)
        found, rest = super().parse_known_args(words, namespace)
        if ros_args:
            found.ros_args = ros_args
        if rest and not hasattr(found, PARSER_OF_REST):
            setattr(found, PARSER_OF_REST, self)
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


def without_ros_args(words: Sequence[str]) -> tuple[list[str], list[str]]:
    """
    Separate the arguments of ROS, which follow `--ros-args` and end at `--`.

    Parameters
    ----------
    words
        The arguments of one parser.

    Returns
    -------
    tuple of two lists of str
        The other arguments, and those of ROS without the two marks.

    """
    others: list[str] = []
    ros_args: list[str] = []
    target = others
    for word in words:
        if word == ROS_ARGS:
            target = ros_args
        elif word == END_OF_OPTIONS and target is ros_args:
            target = others
        else:
            target.append(word)
    return others, ros_args


def options_first(words: Sequence[str], options: Options) -> list[str]:
    """
    Move the options of a command line, with their values, before the other arguments.

    Parameters
    ----------
    words
        The arguments of one parser.
    options
        The options of this parser, by option string such as `-r` or `--rate`.

    Returns
    -------
    list of str
        The options, then `--` and all other arguments, if there are any.

    """
    chosen: list[str] = []
    others: list[str] = []
    left = deque(words)
    while left:
        word = left.popleft()
        if word == END_OF_OPTIONS:
            others += left
            break
        if _is_option(word, options):
            chosen += _with_values(word, left, options)
        else:
            others.append(word)
    return [*chosen, END_OF_OPTIONS, *others] if others else chosen


def _is_option(word: str, options: Options) -> bool:
    if word in options:
        return True
    if not word.startswith('-') or word == '-' or NEGATIVE_NUMBER.fullmatch(word):
        return False
    is_known = word.partition('=')[0] in options or word[:2] in options
    return is_known or ' ' not in word


def _with_values(word: str, left: deque[str], options: Options) -> list[str]:
    """Pop the values of an option from the arguments that follow it."""
    action = _open_option(word, options)
    most = 0.0 if action is None else _most_values(action)
    if most == 1 and left and NEGATIVE_NUMBER.fullmatch(left[0]):
        return [f'{word}={left.popleft()}']
    taken = [word]
    while left and len(taken) <= most and not _ends_values(left[0], options):
        taken.append(left.popleft())
    return taken


def _ends_values(word: str, options: Options) -> bool:
    return word == END_OF_OPTIONS or _is_option(word, options)


def _open_option(word: str, options: Options) -> argparse.Action | None:
    """Return the option that consumes the following arguments as values, if there is one."""
    if word in options:
        return options[word]
    if word.startswith('--'):
        matches = [name for name in options if name.startswith(word)]
        return options[matches[0]] if len(matches) == 1 else None
    return _last_of_cluster(word[1:], options)


def _last_of_cluster(letters: str, options: Options) -> argparse.Action | None:
    """Return the last option of a cluster such as `-abc`; None if an earlier one takes a value."""
    *flags, last = (options.get(f'-{letter}') for letter in letters)
    return last if all(flag is not None and flag.nargs == 0 for flag in flags) else None


def _most_values(action: argparse.Action) -> float:
    if isinstance(action.nargs, int):
        return action.nargs
    return 1 if action.nargs in (None, argparse.OPTIONAL) else UNLIMITED
