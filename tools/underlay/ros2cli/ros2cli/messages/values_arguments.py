# SPDX-License-Identifier: Apache-2.0
"""The option and argument for the values of a message; importing this does not import yaml."""

from __future__ import annotations

import argparse
import sys


def add_values_arguments(parser: argparse.ArgumentParser, what: str) -> None:
    """
    Add the argument for values in YAML, and the option to read them from standard input.

    Parameters
    ----------
    parser
        The parser of the verb.
    what
        The name of the message in the help, such as `goal`.

    """
    source = parser.add_mutually_exclusive_group()
    source.add_argument(
        'values',
        nargs='?',
        default='{}',
        help=f'Values to fill the {what} with in YAML format, otherwise it has default values',
    )
    source.add_argument('--stdin', action='store_true', help='Read values from standard input')


def values_text(args: argparse.Namespace) -> str:
    """
    Return the values in YAML, from the command line or standard input.

    Parameters
    ----------
    args : argparse.Namespace
        The options of `add_values_arguments`.

    Raises
    ------
    RuntimeError
        Standard input is closed, or is not text.

    """
    text: str = _read_stdin() if args.stdin else args.values
    return text


def _read_stdin() -> str:
    if sys.stdin is None:
        raise RuntimeError('--stdin reads values from standard input, which is closed')
    try:
        return sys.stdin.read()
    except UnicodeDecodeError as error:
        raise RuntimeError(f'--stdin reads text, and standard input is none: {error}') from error
