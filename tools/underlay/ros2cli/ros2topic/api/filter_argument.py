# SPDX-License-Identifier: Apache-2.0
"""The option `--filter`; the compiler of filters is only imported for a filter."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import Any


def add_filter_argument(parser: argparse.ArgumentParser, what: str) -> None:
    """
    Add the option `--filter`, a condition that messages must meet.

    Parameters
    ----------
    parser
        The parser of the verb.
    what
        The action of the verb on the messages, for the help, such as `echo`.

    """
    parser.add_argument(
        '--filter',
        type=_message_filter,
        metavar='EXPR',
        help=f'Only {what} messages for which an expression is true. The message is `m`, for '
        'example "m.data > 1 and len(m.name) == 2"',
    )


def _message_filter(text: str) -> Callable[[Any], bool]:
    from ros2topic.api.filtering import MessageFilter

    return MessageFilter(text)
