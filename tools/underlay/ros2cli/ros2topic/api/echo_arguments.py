# SPDX-License-Identifier: Apache-2.0
"""The options of `ros2 topic echo` that concern its output."""

from __future__ import annotations

import argparse

from ros2cli.argument_types import positive_number, whole_number
from ros2topic.api.filter_argument import add_filter_argument

DEFAULT_TRUNCATE_LENGTH = 128


def add_echo_arguments(parser: argparse.ArgumentParser) -> None:
    """
    Add the options for the output format, the selection of messages and the end.

    Parameters
    ----------
    parser
        The parser of the verb.

    """
    add_form_arguments(parser)
    _add_selection(parser)
    _add_limits(parser)


def add_form_arguments(parser: argparse.ArgumentParser) -> None:
    """
    Add the options for the output format: YAML or CSV, and limits for arrays and strings.

    Parameters
    ----------
    parser
        The parser of the verb.

    """
    add = parser.add_argument
    add(
        '--csv',
        action='store_true',
        help='Output all recursive fields separated by commas (e.g. for plotting)',
    )
    add(
        '-f',
        '--full-length',
        action='store_true',
        help='Output all elements for arrays, bytes, and strings',
    )
    add(
        '-l',
        '--truncate-length',
        metavar='N',
        type=whole_number,
        default=DEFAULT_TRUNCATE_LENGTH,
        help='The length to truncate arrays, bytes, and strings to (default: %(default)s)',
    )
    add('--no-arr', action='store_true', help="Don't print array fields of messages")
    add('--no-str', action='store_true', help="Don't print string fields of messages")
    add(
        '--flow-style',
        action='store_true',
        help='Print collections in the flow style, on one line',
    )


def _add_selection(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add('--field', help='Echo a selected field of a message, e.g. "pose.position"')
    add_filter_argument(parser, 'echo')
    add('--raw', action='store_true', help='Echo the raw binary representation')
    add(
        '-i',
        '--include-message-info',
        action='store_true',
        help='Shows the associated message info',
    )


def _add_limits(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add('--no-lost-messages', action='store_true', help="Don't report when a message is lost")
    add('--once', action='store_true', help='Print the first message received and then exit')
    add('--timeout', metavar='SECONDS', type=positive_number, help='Stop after this time')
