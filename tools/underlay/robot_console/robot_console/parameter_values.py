# SPDX-License-Identifier: Apache-2.0
"""How the value of a parameter becomes text, and the text that a user types a value."""

from __future__ import annotations

from collections.abc import Callable, Mapping
import json
import math
from typing import Any, NamedTuple

from rcl_interfaces.msg import ParameterDescriptor, ParameterValue
from ros2param.api.values import parse_value, to_plain_value, type_name, TYPES
import yaml

__all__ = ['Limits', 'described', 'parameter_value', 'typed_value', 'value_text']

BOOLEAN, INTEGER, DOUBLE, STRING = 'boolean', 'integer', 'double', 'string'
BYTE_ARRAY, NOT_SET = 'byte array', 'not set'
ARRAY = ' array'

WORDS = {'true': True, 'false': False}
LARGEST = 2**63
SLACK = 1e-9

KINDS = {each.name: number for number, each in TYPES.items()}


def _item_kind(kind: str) -> str:
    """
    Return the element type of an array type.

    Parameters
    ----------
    kind
        The name of the type, for example `double array`.

    Returns
    -------
    str
        For example `double`; '' if the type is not an array.

    """
    return kind.removesuffix(ARRAY) if kind.endswith(ARRAY) else ''


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
    item = _item_kind(kind)
    if item:
        return [_checked(READERS[item](each), limits) for each in _items(text)]
    if kind not in READERS:
        raise ValueError(f'Parameters of type {kind} cannot be changed here.')
    value = READERS[kind](text.strip() if kind != STRING else text)
    return _checked(value, limits)


def _items(text: str) -> list[Any]:
    """Parse the items of a YAML list as strings."""
    try:
        items = yaml.load(text, yaml.BaseLoader)  # noqa: S506 (the loader makes nothing but texts)
    except yaml.YAMLError:
        items = None
    if not isinstance(items, list) or not all(isinstance(each, str) for each in items):
        raise ValueError(f'It must be a list such as [1, 2], not {text!r}.')
    return items


def _boolean(text: str) -> bool:
    try:
        return WORDS[text.lower()]
    except KeyError:
        raise ValueError(f'It must be true or false, not {text!r}.') from None


def _integer(text: str) -> int:
    try:
        value = int(text, 0)
    except ValueError:
        raise ValueError(f'It must be a whole number, not {text!r}.') from None
    if not -LARGEST <= value < LARGEST:
        raise ValueError(f'{text} is too large: a whole number has 64 bits.')
    return value


def _double(text: str) -> float:
    try:
        return float(text.replace('.inf', 'inf').replace('.nan', 'nan'))
    except ValueError:
        raise ValueError(f'It must be a number, not {text!r}.') from None


def _byte(text: str) -> bytes:
    value = _integer(text)
    if not 0 <= value <= 255:
        raise ValueError(f'A byte must be from 0 to 255, not {text}.')
    return bytes([value])


READERS: Mapping[str, Callable[[str], Any]] = {
    BOOLEAN: _boolean,
    INTEGER: _integer,
    DOUBLE: _double,
    STRING: str,
    _item_kind(BYTE_ARRAY): _byte,
}


def _checked(value: Any, limits: Limits | None) -> Any:
    """Return a value if it is within the limits, otherwise raise ValueError."""
    if limits is None or isinstance(value, (bool, str, bytes)):
        return value
    if not limits.least <= value <= limits.most:
        raise ValueError(f'It must be from {limits.least:g} to {limits.most:g}, not {value}.')
    if limits.step and value != limits.most:
        steps = (value - limits.least) / limits.step
        if not math.isclose(steps, round(steps), abs_tol=SLACK):
            raise ValueError(
                f'It must be {limits.least:g} plus steps of {limits.step:g}, not {value}.'
            )
    return value


def value_text(value: ParameterValue) -> str:
    """
    Format the value of a parameter as a user would type it.

    Parameters
    ----------
    value
        The value; '' is returned if the parameter is not set.

    """
    plain = to_plain_value(value)
    if plain is None:
        return ''
    if isinstance(plain, str):
        return plain
    if isinstance(plain, list):
        return f'[{", ".join(_item(each) for each in plain)}]'
    return _item(plain)


def described(value: ParameterValue, descriptor: ParameterDescriptor | None) -> dict[str, Any]:
    """
    Describe a parameter for the page.

    Parameters
    ----------
    value
        Its value, which determines its type.
    descriptor
        Its description, limits and constraints; None if the node has not provided them.

    Returns
    -------
    dict
        The type as `kind`, the value as `text`, and the contents of the descriptor.

    """
    told: dict[str, Any] = {'kind': type_name(value.type), 'text': value_text(value)}
    if descriptor is None:
        return told
    limits = _limits(descriptor)
    return {
        **told,
        'about': descriptor.description,
        'fixed': descriptor.read_only,
        'any': descriptor.dynamic_typing,
        'limits': _limits_text(limits),
        'rule': descriptor.additional_constraints,
    }


def parameter_value(
    text: str, current: ParameterValue, descriptor: ParameterDescriptor
) -> ParameterValue:
    """
    Parse the text that a user typed as the new value of a parameter.

    Parameters
    ----------
    text
        The typed text; parsed as YAML if the type of the parameter may change or is not set.
    current
        The current value of the parameter, whose type is kept otherwise.
    descriptor
        Its descriptor, with limits and whether it is read-only.

    Raises
    ------
    ValueError
        The parameter is read-only, or the text is not a value of its type or within the limits.

    """
    if descriptor.read_only:
        raise ValueError('It can only be set when the node starts.')
    kind = type_name(current.type)
    if kind == NOT_SET or descriptor.dynamic_typing:
        return _any_value(text)
    value = ParameterValue(type=KINDS[kind])
    plain = typed_value(kind, text, _limits(descriptor))
    setattr(value, TYPES[value.type].field, plain)
    return value


def _any_value(text: str) -> ParameterValue:
    try:
        return parse_value(text)
    except RuntimeError as error:
        raise ValueError(str(error)) from error


def _limits(descriptor: ParameterDescriptor) -> Limits | None:
    for each in (*descriptor.integer_range, *descriptor.floating_point_range):
        return Limits(each.from_value, each.to_value, each.step)
    return None


def _limits_text(limits: Limits | None) -> str:
    if limits is None:
        return ''
    step = f' in steps of {limits.step:g}' if limits.step else ''
    return f'from {limits.least:g} to {limits.most:g}{step}'


def _item(plain: Any) -> str:
    if isinstance(plain, bool):
        return 'true' if plain else 'false'
    if isinstance(plain, bytes):
        return str(plain[0])
    return json.dumps(plain, ensure_ascii=False) if isinstance(plain, str) else repr(plain)
