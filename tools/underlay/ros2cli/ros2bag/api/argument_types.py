# SPDX-License-Identifier: Apache-2.0
"""Numbers on the command line that may be zero."""

from __future__ import annotations

import argparse

__all__ = ['count', 'not_negative']


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
