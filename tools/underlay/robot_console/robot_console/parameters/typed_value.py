# SPDX-License-Identifier: Apache-2.0
"""Parsing of parameter values that users type."""

from __future__ import annotations

from collections.abc import Callable, Mapping
import math
from typing import Any, NamedTuple

from robot_console.parameters.kinds import (
    BOOLEAN,
    BYTE_ARRAY,
    DOUBLE,
    INTEGER,
    item_kind,
    STRING,
)
import yaml

__all__ = ['Limits', 'typed_value']

WORDS = {'true': True, 'false': False}
LARGEST = 2**63
SLACK = 1e-9


class Limits(NamedTuple):
    """Range of a number: minimum, maximum, and step if there is one."""

    least: float
    most: float
    step: float = 0.0


def typed_value(kind: str, text: str, limits: Limits | None = None) -> Any:
    """
    Parse a text as a parameter value of a given type.

    Parameters
    ----------
    kind
        The name of the type, for example `double` or `string array`.
    text
        The typed text; arrays as a YAML list.
    limits
        Limits of numbers, also of each element of an array; None for no limits.

    Returns
    -------
    Any
        A plain value, or a list of values; those of a byte array are `bytes` of length 1.

    Raises
    ------
    ValueError
        The text is not a valid value or not within the limits; the message is a full sentence.

    """
    item = item_kind(kind)
    if item:
        return [_checked(READERS[item](each), limits) for each in _items(text)]
    if kind not in READERS:
        raise ValueError(f'Parameters of the type {kind} cannot be changed here.')
    value = READERS[kind](text.strip() if kind != STRING else text)
    return _checked(value, limits)


def _items(text: str) -> list[Any]:
    """Parse the items of a YAML list as strings."""
    try:
        items = yaml.load(text, yaml.BaseLoader)  # noqa: S506 (the loader makes nothing but texts)
    except yaml.YAMLError:
        items = None
    if not isinstance(items, list) or not all(isinstance(each, str) for each in items):
        raise ValueError(f'It must be a list such as [1, 2], and not {text!r}.')
    return items


def _boolean(text: str) -> bool:
    try:
        return WORDS[text.lower()]
    except KeyError:
        raise ValueError(f'It must be true or false, and not {text!r}.') from None


def _integer(text: str) -> int:
    try:
        value = int(text, 0)
    except ValueError:
        raise ValueError(f'It must be a whole number, and not {text!r}.') from None
    if not -LARGEST <= value < LARGEST:
        raise ValueError(f'{text} is too large: a whole number has 64 bits.')
    return value


def _double(text: str) -> float:
    try:
        return float(text.replace('.inf', 'inf').replace('.nan', 'nan'))
    except ValueError:
        raise ValueError(f'It must be a number, and not {text!r}.') from None


def _byte(text: str) -> bytes:
    value = _integer(text)
    if not 0 <= value <= 255:
        raise ValueError(f'A byte must be from 0 to 255, and not {text}.')
    return bytes([value])


READERS: Mapping[str, Callable[[str], Any]] = {
    BOOLEAN: _boolean,
    INTEGER: _integer,
    DOUBLE: _double,
    STRING: str,
    item_kind(BYTE_ARRAY): _byte,
}


def _checked(value: Any, limits: Limits | None) -> Any:
    """Return a value if it is within the limits, otherwise raise ValueError."""
    if limits is None or isinstance(value, (bool, str, bytes)):
        return value
    if not limits.least <= value <= limits.most:
        raise ValueError(f'It must be from {limits.least:g} to {limits.most:g}, and not {value}.')
    if limits.step and value != limits.most:
        steps = (value - limits.least) / limits.step
        if not math.isclose(steps, round(steps), abs_tol=SLACK):
            raise ValueError(
                f'It must be {limits.least:g} plus steps of {limits.step:g}, and not {value}.'
            )
    return value
