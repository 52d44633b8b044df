# SPDX-License-Identifier: Apache-2.0
"""Numbers on the command line."""

from __future__ import annotations

import argparse


def positive_int(text: str) -> int:
    """Return a whole number above zero, or say why a text is none."""
    try:
        value = int(text)
    except ValueError:
        value = 0
    if value <= 0:
        raise argparse.ArgumentTypeError(f'{text!r} is not a whole number above zero')
    return value


def positive_number(text: str) -> float:
    """Return a finite number above zero, or say why a text is none."""
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0.0 < value < float('inf'):
        raise argparse.ArgumentTypeError(f'{text!r} is not a number above zero')
    return value


def whole_number(text: str) -> int:
    """Return a whole number that is not negative, or say why a text is none."""
    if not (text.isascii() and text.isdigit()):
        raise argparse.ArgumentTypeError(f'{text!r} is not a whole number')
    return int(text)


def node_name(text: str) -> str:
    """Return a node's name without its namespace, or say why a text is none."""
    if not (text.isascii() and text.isidentifier()):
        raise argparse.ArgumentTypeError(
            f'{text!r} is no name of a node: letters, digits and underscores, no digit first'
        )
    return text
