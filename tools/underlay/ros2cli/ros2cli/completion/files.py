# SPDX-License-Identifier: Apache-2.0
"""Complete paths."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
import os

Choice = Callable[[str], bool]


def files(prefix: str, args: argparse.Namespace | None = None) -> list[str]:
    """
    List the files and folders that complete a path.

    Parameters
    ----------
    prefix
        The word to complete.
    args : argparse.Namespace | None
        The parsed arguments (unused).

    """
    return _paths(prefix, bool)


def folders(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the folders that complete a path.

    Parameters
    ----------
    prefix
        The word to complete.
    args : argparse.Namespace
        The parsed arguments (unused).

    """
    return _paths(prefix, lambda name: False)


def bags(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the folders and bag files that complete a path.

    Parameters
    ----------
    prefix
        The word to complete.
    args : argparse.Namespace
        The parsed arguments (unused).

    """
    return files_of_kind(prefix, ('.mcap', '.db3'))


def files_of_kind(prefix: str, suffixes: tuple[str, ...]) -> list[str]:
    """
    List the files with certain suffixes, and all folders, that complete a path.

    Parameters
    ----------
    prefix
        The word to complete.
    suffixes
        The file name suffixes, each with its dot.

    Returns
    -------
    list of str
        Paths that start with the word; folders have a trailing slash.

    """
    return _paths(prefix, lambda name: name.endswith(suffixes))


def as_path(word: str) -> str:
    """
    Expand `~` and variables in a word as the shell will.

    Parameters
    ----------
    word
        A word of the command line.

    """
    return os.path.expanduser(os.path.expandvars(word))


def _paths(prefix: str, is_wanted: Choice) -> list[str]:
    """Return the completions of a path; keep its leading part as typed."""
    head, slash, tail = prefix.rpartition(os.sep)
    found = sorted(_names(as_path(head + slash) or os.curdir, tail, is_wanted))
    return [f'{head}{slash}{name}' for name in found]


def _names(folder: str, beginning: str, is_wanted: Choice) -> Iterator[str]:
    """Yield the entries of a folder; dotfiles only if the word starts with a dot."""
    try:
        entries = list(os.scandir(folder))
    except OSError:
        return
    for entry in entries:
        if entry.name.startswith(beginning or '.') == bool(beginning):
            if entry.is_dir():
                yield f'{entry.name}{os.sep}'
            elif is_wanted(entry.name):
                yield entry.name
