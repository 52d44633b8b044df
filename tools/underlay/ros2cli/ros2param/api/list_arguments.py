# SPDX-License-Identifier: Apache-2.0
"""The options of `ros2 param list`."""

from __future__ import annotations

import argparse
import re


def add_list_arguments(parser: argparse.ArgumentParser) -> None:
    """
    Add the options that filter the parameters and show their types.

    Parameters
    ----------
    parser
        The parser of the verb.

    """
    parser.add_argument(
        '--param-prefixes',
        nargs='+',
        default=[],
        help='Only list parameters with the provided prefixes',
    )
    parser.add_argument(
        '--param-type', action='store_true', help='Print parameter types with parameter names'
    )
    parser.add_argument(
        '--filter',
        type=_regular_expression,
        metavar='REGEX',
        help='Only list parameters matching the provided regex',
    )


def _regular_expression(text: str) -> re.Pattern[str]:
    try:
        return re.compile(text)
    except re.error as error:
        raise argparse.ArgumentTypeError(f'{text!r} is no regular expression: {error}') from error
