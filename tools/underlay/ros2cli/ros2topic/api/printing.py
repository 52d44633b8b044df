# SPDX-License-Identifier: Apache-2.0
"""How `ros2 topic echo` prints a message."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import Any

from ros2cli.messages.field_hint import field_hint
from ros2cli.messages.plain import Shortening
from ros2cli.messages.text import to_csv, to_yaml

SEPARATOR = '---'


def formatter(args: argparse.Namespace) -> Callable[[Any, Any], str]:
    """Return the function that turns a message and its info into what the options ask for."""
    shortening = chosen_shortening(args)
    end = '\n' if args.csv and not args.raw else f'{SEPARATOR}\n'

    def format_message(message: Any, info: Any) -> str:
        value = nested_field(message, args.field) if args.field else message
        texts = [to_yaml(info)] if args.include_message_info else []
        return ''.join([*texts, value_text(value, shortening, args), end])

    return format_message


def chosen_shortening(args: argparse.Namespace) -> Shortening:
    """Return the limits of texts and arrays that the options choose."""
    length = None if args.full_length else args.truncate_length
    return Shortening(length, args.no_arr, args.no_str)


def nested_field(message: Any, path: str) -> Any:
    """Return the value of a field, named with dots between the levels."""
    value = message
    for name in path.split('.'):
        if name not in getattr(value, 'get_fields_and_field_types', dict)():
            text = f"'{type(value).__name__}' object has no attribute '{name}'"
            error = AttributeError(text, name=name, obj=value)
            lines = [f"Invalid field '{path}': {error}", field_hint(error)]
            raise RuntimeError('\n'.join(lines).rstrip())
        value = getattr(value, name)
    return value


def value_text(value: Any, shortening: Shortening, args: argparse.Namespace) -> str:
    """Return a message or the value of a field as YAML or with commas."""
    if args.csv and not args.raw:
        return to_csv(value, shortening)
    if isinstance(value, bytes):
        return f'{value!r}\n'
    if isinstance(value, (bool, int, float, str)):
        return f'{value}\n'
    return to_yaml(value, shortening, flow_style=args.flow_style)
