# SPDX-License-Identifier: Apache-2.0
"""
Reordering of a command line: options before other arguments.

argparse leaves an optional positional empty as soon as an option precedes it, and mistakes
numbers such as -1e3 for options. The order produced here rules out both.
"""

from __future__ import annotations

import argparse
from collections import deque
from collections.abc import Mapping, Sequence
import re

END_OF_OPTIONS = '--'
NEGATIVE_NUMBER = re.compile(r'-((\d+\.?\d*|\.\d+)(e[-+]?\d+)?|\.inf)', re.IGNORECASE)
UNLIMITED = float('inf')

Options = Mapping[str, argparse.Action]


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
