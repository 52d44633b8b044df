# SPDX-License-Identifier: Apache-2.0
"""Argument types of the benchmarks for argparse, with error messages for invalid values."""

from __future__ import annotations

import argparse
from collections.abc import Callable
import math
from pathlib import Path
from typing import TypeVar

Number = TypeVar('Number', int, float)
_NAMES = {int: 'a whole number', float: 'a number'}


def in_range(kind: type[Number], least: float, most: float = math.inf) -> Callable[[str], Number]:
    """
    Make a type for argparse that accepts finite numbers in a range.

    Parameters
    ----------
    kind
        `int` or `float`.
    least, most
        The smallest and the largest accepted number.

    Returns
    -------
    Callable
        Parses a text, and raises `argparse.ArgumentTypeError` if it is not such a number.

    """
    bounds = f'of at least {least:g}' if most == math.inf else f'from {least:g} to {most:g}'

    def number(text: str) -> Number:
        try:
            value = kind(text)
        except ValueError:
            value = None
        if value is None or math.isinf(value) or not least <= value <= most:
            raise argparse.ArgumentTypeError(f"'{text}' is not {_NAMES[kind]} {bounds}.")
        return value

    return number


def built_workspace(text: str) -> Path:
    """
    Return the folder of a built workspace; a type for argparse.

    Parameters
    ----------
    text
        The path of the folder.

    Raises
    ------
    ArgumentTypeError
        The folder is not a built workspace.

    """
    folder = _folder(text)
    if not (folder / 'tools' / 'in_environment').is_file() or not (folder / 'install').is_dir():
        raise argparse.ArgumentTypeError(
            f"'{folder}' is not a built workspace: tools/in_environment or install/ is missing. "
            'Check out the commit to compare with there, and run `make build` in it.'
        )
    return folder


def workspace_sources(text: str) -> Path:
    """
    Return the folder of a workspace, built or not, that is a git clone; a type for argparse.

    Parameters
    ----------
    text
        The path of the folder.

    Raises
    ------
    ArgumentTypeError
        The folder is not a clone of a workspace.

    """
    folder = _folder(text)
    if not (folder / 'tools' / 'setup').is_dir() or not (folder / '.git').exists():
        raise argparse.ArgumentTypeError(
            f"'{folder}' is not a clone of this workspace: tools/setup or .git is missing. "
            'Make one with `git clone` and check out the commit to compare with there.'
        )
    return folder


def _folder(text: str) -> Path:
    if not text.strip():
        raise argparse.ArgumentTypeError('an empty text names no folder.')
    return Path(text).resolve()
