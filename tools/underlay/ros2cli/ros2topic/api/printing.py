# SPDX-License-Identifier: Apache-2.0
"""Message formatting of `ros2 topic echo`."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import Any

from ros2cli.messages.field_hint import field_hint
from ros2cli.messages.plain import Shortening
from ros2cli.messages.text import to_csv, to_yaml

SEPARATOR = '---'


def formatter(args: argparse.Namespace) -> Callable[[Any, Any], str]:
    """
    Create the function that formats messages according to the options.

    Parameters
    ----------
    args : argparse.Namespace
        The parsed command line of `ros2 topic echo`.

    Returns
    -------
    callable
        Accepts a message, as bytes if `raw` is set, and its message info; returns the text with
        the separator. It raises RuntimeError if the messages lack the chosen field.

    """
    shortening = chosen_shortening(args)
    end = '\n' if args.csv and not args.raw else f'{SEPARATOR}\n'

    def format_message(message: Any, info: Any) -> str:
        value = nested_field(message, args.field) if args.field else message
        texts = [to_yaml(info)] if args.include_message_info else []
        return ''.join([*texts, value_text(value, shortening, args), end])

    return format_message


def chosen_shortening(args: argparse.Namespace) -> Shortening:
    """
    Read the limits for strings and arrays from the options.

    Parameters
    ----------
    args : argparse.Namespace
        The parsed command line with the options of `add_form_arguments`.

    """
    length = None if args.full_length else args.truncate_length
    return Shortening(length, args.no_arr, args.no_str)


def nested_field(message: Any, path: str) -> Any:
    """
    Get the value of a nested field of a message.

    Parameters
    ----------
    message
        The message.
    path
        The names of the nested fields, joined by dots, such as `pose.position`.

    Raises
    ------
    RuntimeError
        The message has no such field; the error suggests one if a name is close.

    """
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
    """
    Format a message or the value of a field as YAML or CSV.

    Parameters
    ----------
    value
        The message, the value of a field, or the bytes of a serialized message.
    shortening
        The limits for strings and arrays.
    args : argparse.Namespace
        The parsed command line: `csv`, `raw` and `flow_style` choose the format.

    Returns
    -------
    str
        The text, with a final line break unless it is CSV.

    """
    if args.csv and not args.raw:
        return to_csv(value, shortening)
    if isinstance(value, bytes):
        return f'{value!r}\n'
    if isinstance(value, (bool, int, float, str)):
        return f'{value}\n'
    return to_yaml(value, shortening, flow_style=args.flow_style)
