# SPDX-License-Identifier: Apache-2.0
"""Argument types for numbers and names on the command line."""

from __future__ import annotations

import argparse


def positive_int(text: str) -> int:
    """
    Parse a positive integer argument.

    Parameters
    ----------
    text
        The argument text.

    Returns
    -------
    int
        One or more.

    Raises
    ------
    argparse.ArgumentTypeError
        The text is not such a number.

    """
    try:
        value = int(text)
    except ValueError:
        value = 0
    if value <= 0:
        raise argparse.ArgumentTypeError(f'{text!r} is not a whole number above zero')
    return value


def positive_number(text: str) -> float:
    """
    Parse a finite positive number argument.

    Parameters
    ----------
    text
        The argument text.

    Returns
    -------
    float
        More than zero.

    Raises
    ------
    argparse.ArgumentTypeError
        The text is not such a number.

    """
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0.0 < value < float('inf'):
        raise argparse.ArgumentTypeError(f'{text!r} is not a number above zero')
    return value


def whole_number(text: str) -> int:
    """
    Parse a non-negative integer argument, written in digits only.

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
    if not (text.isascii() and text.isdigit()):
        raise argparse.ArgumentTypeError(f'{text!r} is not a whole number')
    return int(text)


def node_name(text: str) -> str:
    """
    Validate a node name argument, without namespace.

    Parameters
    ----------
    text
        The argument text.

    Returns
    -------
    str
        The text itself.

    Raises
    ------
    argparse.ArgumentTypeError
        The text is not a valid name.

    """
    if not (text.isascii() and text.isidentifier()):
        raise argparse.ArgumentTypeError(
            f'{text!r} is not a valid node name: letters, digits and underscores, no digit first'
        )
    return text
