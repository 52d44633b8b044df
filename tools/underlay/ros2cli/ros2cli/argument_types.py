# SPDX-License-Identifier: Apache-2.0
"""Numbers on the command line."""

from __future__ import annotations

import argparse


def positive_int(text: str) -> int:
    """
    Parse a positive integer of the command line.

    Parameters
    ----------
    text
        The word that the user has written.

    Returns
    -------
    int
        One or more.

    Raises
    ------
    argparse.ArgumentTypeError
        The text is no such number.

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
    Parse a finite positive number of the command line.

    Parameters
    ----------
    text
        The word that the user has written.

    Returns
    -------
    float
        More than zero.

    Raises
    ------
    argparse.ArgumentTypeError
        The text is no such number.

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
    Parse a non-negative integer of the command line, written in digits only.

    Parameters
    ----------
    text
        The word that the user has written.

    Returns
    -------
    int
        Zero or more.

    Raises
    ------
    argparse.ArgumentTypeError
        The text is no such number.

    """
    if not (text.isascii() and text.isdigit()):
        raise argparse.ArgumentTypeError(f'{text!r} is not a whole number')
    return int(text)


def node_name(text: str) -> str:
    """
    Check the name of a node, without its namespace, on the command line.

    Parameters
    ----------
    text
        The word that the user has written.

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
            f'{text!r} is no name of a node: letters, digits and underscores, no digit first'
        )
    return text
