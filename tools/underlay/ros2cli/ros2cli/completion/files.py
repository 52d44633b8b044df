# SPDX-License-Identifier: Apache-2.0
"""Complete paths."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
import os

Choice = Callable[[str], bool]


def files(prefix: str, args: argparse.Namespace | None = None) -> list[str]:
    """Return the files and folders that a word may go on to."""
    return _paths(prefix, bool)


def folders(prefix: str, args: argparse.Namespace) -> list[str]:
    """Return the folders that a word may go on to."""
    return _paths(prefix, lambda name: False)


def bags(prefix: str, args: argparse.Namespace) -> list[str]:
    """Return the folders and the files of bags."""
    return files_of_kind(prefix, ('.mcap', '.db3'))


def files_of_kind(prefix: str, suffixes: tuple[str, ...]) -> list[str]:
    """Return the files with one of some suffixes, and all folders."""
    return _paths(prefix, lambda name: name.endswith(suffixes))


def as_path(word: str) -> str:
    """Return what the shell will make of a word that begins with ~ or a variable."""
    return os.path.expanduser(os.path.expandvars(word))


def _paths(prefix: str, is_wanted: Choice) -> list[str]:
    """Return what a path may go on to; its beginning stays as it was written."""
    head, slash, tail = prefix.rpartition(os.sep)
    found = sorted(_names(as_path(head + slash) or os.curdir, tail, is_wanted))
    return [f'{head}{slash}{name}' for name in found]


def _names(folder: str, beginning: str, is_wanted: Choice) -> Iterator[str]:
    """Yield what lies in a folder; names that begin with a dot only if the word does."""
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
