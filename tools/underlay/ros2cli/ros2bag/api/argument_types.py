# SPDX-License-Identifier: Apache-2.0
"""Argument types for numbers that may be zero, and options that are rejected with a reason."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from typing import Any

__all__ = ['Refused', 'count', 'not_negative']


def count(text: str) -> int:
    """
    Parse a non-negative integer argument.

    Parameters
    ----------
    text
        The argument text.

    Returns
    -------
    int
        Zero or more.

    Raises
    ------
    argparse.ArgumentTypeError
        The text is not such a number.

    """
    try:
        value = int(text)
    except ValueError:
        value = -1
    if value < 0:
        raise argparse.ArgumentTypeError(f'{text!r} is not a non-negative integer')
    return value


def not_negative(text: str) -> float:
    """
    Parse a finite non-negative number argument.

    Parameters
    ----------
    text
        The argument text.

    Returns
    -------
    float
        Zero or more.

    Raises
    ------
    argparse.ArgumentTypeError
        The text is not such a number.

    """
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0.0 <= value < float('inf'):
        raise argparse.ArgumentTypeError(f'{text!r} is not a non-negative number')
    return value


class Refused(argparse.Action):
    """
    Argparse action of a rosbag2 option that is not supported here.

    Using the option is a usage error with the reason; the help does not list it.

    Parameters
    ----------
    option_strings, dest
        As argparse passes them; values that follow the option are ignored.
    reason
        The text of the usage error after "is not supported here:".

    """

    def __init__(self, option_strings: Sequence[str], dest: str, *, reason: str) -> None:
        super().__init__(option_strings, dest, nargs='*', help=argparse.SUPPRESS)
        self._reason = reason

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        """Exit with a usage error."""
        parser.error(f'{option_string} is not supported here: {self._reason}')
