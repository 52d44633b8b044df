# SPDX-License-Identifier: Apache-2.0
"""What arguments of programs are made to."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from math import nan

__all__ = ['number_in']


def number_in(low: float, high: float, what: str) -> Callable[[str], float]:
    """Return a function that makes a number in a range of an argument, or says what is wrong."""

    def read(text: str) -> float:
        number = _number(text)
        if not low <= number <= high:
            raise argparse.ArgumentTypeError(
                f'{text!r} is no {what}: give a number from {low:g} to {high:g}'
            )
        return number

    return read


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return nan
