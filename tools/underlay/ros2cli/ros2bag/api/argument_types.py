# SPDX-License-Identifier: Apache-2.0
"""Numbers on the command line that may be zero, and options that are refused with a reason."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from typing import Any

__all__ = ['Refused', 'count', 'not_negative']


def count(text: str) -> int:
    """Return a whole number from zero on, or say why a text is none."""
    try:
        value = int(text)
    except ValueError:
        value = -1
    if value < 0:
        raise argparse.ArgumentTypeError(f'{text!r} is not a whole number from zero on')
    return value


def not_negative(text: str) -> float:
    """Return a finite number from zero on, or say why a text is none."""
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0.0 <= value < float('inf'):
        raise argparse.ArgumentTypeError(f'{text!r} is not a number from zero on')
    return value


class Refused(argparse.Action):
    """An option of rosbag2 that is not here; who uses it is told why, and no help lists it."""

    def __init__(self, option_strings: Sequence[str], dest: str, *, reason: str) -> None:
        """Take any values, since they do not matter."""
        super().__init__(option_strings, dest, nargs='*', help=argparse.SUPPRESS)
        self._reason = reason

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        """End with a usage error."""
        parser.error(f'{option_string} is not possible here: {self._reason}')
