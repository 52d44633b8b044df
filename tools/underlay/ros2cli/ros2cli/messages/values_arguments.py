# SPDX-License-Identifier: Apache-2.0
"""The option and argument for the values of a message; importing this does not import yaml."""

from __future__ import annotations

import argparse
import sys


def add_values_arguments(parser: argparse.ArgumentParser, what: str) -> None:
    """Add the values in YAML, or the choice to read them from standard input."""
    source = parser.add_mutually_exclusive_group()
    source.add_argument(
        'values',
        nargs='?',
        default='{}',
        help=f'Values to fill the {what} with in YAML format, otherwise it has default values',
    )
    source.add_argument('--stdin', action='store_true', help='Read values from standard input')


def values_text(args: argparse.Namespace) -> str:
    """Return the values that were given on the command line or on standard input."""
    text: str = _read_stdin() if args.stdin else args.values
    return text


def _read_stdin() -> str:
    if sys.stdin is None:
        raise RuntimeError('--stdin reads values from standard input, which is closed')
    try:
        return sys.stdin.read()
    except UnicodeDecodeError as error:
        raise RuntimeError(f'--stdin reads text, and standard input is none: {error}') from error
