# SPDX-License-Identifier: Apache-2.0
"""How `ros2 topic echo` prints a message."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import Any

from ros2cli.messages.plain import Shortening
from ros2cli.messages.text import to_csv, to_yaml

SEPARATOR = '---'


def printer(args: argparse.Namespace) -> Callable[[Any, Any], None]:
    """Return the function that prints a message and its info as the options say."""
    shortening = Shortening(
        None if args.full_length else args.truncate_length, args.no_arr, args.no_str
    )

    def print_message(message: Any, info: Any) -> None:
        value = nested_field(message, args.field) if args.field else message
        texts = [to_yaml(info)] if args.include_message_info else []
        texts.append(_value_text(value, shortening, args))
        print(''.join(texts), end='\n' if args.csv else f'{SEPARATOR}\n')

    return print_message


def nested_field(message: Any, path: str) -> Any:
    """Return the value of a field, named with dots between the levels."""
    value = message
    for name in path.split('.'):
        try:
            value = getattr(value, name)
        except AttributeError as error:
            raise RuntimeError(f"Invalid field '{path}': {error}") from error
    return value


def _value_text(value: Any, shortening: Shortening, args: argparse.Namespace) -> str:
    if args.csv:
        return to_csv(value, shortening)
    if args.raw or isinstance(value, (bool, int, float, str, bytes)):
        return f'{value}\n'
    return to_yaml(value, shortening, flow_style=args.flow_style)
