# SPDX-License-Identifier: Apache-2.0
"""Argparse types for command line arguments."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from math import nan

__all__ = ['number_in']


def number_in(low: float, high: float, what: str) -> Callable[[str], float]:
    """
    Create an argparse type for numbers in a range.

    Parameters
    ----------
    low, high
        The range, including both limits.
    what
        Description of the number, with its unit, for the error message: 'rate in Hz'.

    Returns
    -------
    Callable
        Converts an argument to a number, or raises `argparse.ArgumentTypeError`.

    """

    def read(text: str) -> float:
        number = _number(text)
        if not low <= number <= high:
            raise argparse.ArgumentTypeError(
                f'{text!r} is not a {what}: give a number from {low:g} to {high:g}'
            )
        return number

    return read


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return nan
