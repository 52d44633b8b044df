# SPDX-License-Identifier: Apache-2.0
"""Complete paths."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from typing import Any

from argcomplete.completers import DirectoriesCompleter, FilesCompleter


def files(prefix: str, args: argparse.Namespace | None = None) -> list[str]:
    """Return the files and folders that a word may go on to."""
    return _paths(FilesCompleter(), prefix)


def folders(prefix: str, args: argparse.Namespace) -> list[str]:
    """Return the folders that a word may go on to."""
    return _paths(DirectoriesCompleter(), prefix)


def files_of_kind(prefix: str, suffixes: Iterable[str]) -> list[str]:
    """Return the files with one of some suffixes, and all folders."""
    return _paths(FilesCompleter(tuple(suffixes)), prefix)


def _paths(completer: Any, prefix: str) -> list[str]:
    return list(completer(prefix=prefix))
