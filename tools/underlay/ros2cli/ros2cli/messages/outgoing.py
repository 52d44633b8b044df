# SPDX-License-Identifier: Apache-2.0
"""Messages filled from the values on the command line."""

from __future__ import annotations

from collections.abc import Callable
import re
from typing import Any

from ros2cli.messages.lookup import field_hint, get_message, UnknownType
from ros2cli.messages.text import element_type
from ros2cli.messages.values import parse_values

FIELD_ERROR = 'Failed to populate field: {}'
HEADER, TIME = 'std_msgs/Header', 'builtin_interfaces/Time'


class OutgoingMessage:
    """
    Message from the command line whose time stamps are set each time it is sent.

    Parameters
    ----------
    message
        The message, with default values; also an attribute.
    text
        The values of its fields in YAML.
    error_text
        The error message for values that do not fit, with a placeholder for the reason.

    Raises
    ------
    RuntimeError
        The text is not a YAML mapping, or its values do not fit the message.

    """

    def __init__(self, message: Any, text: str, error_text: str = FIELD_ERROR) -> None:
        self.message = message
        values = parse_values(text)
        try:
            self._stamps = fill(message, values)
        except (AttributeError, AssertionError, TypeError, ValueError, UnknownType) as error:
            lines = [error_text.format(error), field_hint(error)]
            raise RuntimeError('\n'.join(lines).rstrip()) from error

    def stamped(self, now: Any) -> Any:
        """
        Set the time stamps, and return the message.

        Parameters
        ----------
        now
            The time, a builtin_interfaces/msg/Time.

        """
        for stamp in self._stamps:
            stamp(now)
        return self.message


def _boolean(value: Any) -> bool:
    """Validate a YAML boolean; any other value would be truthy in Python, even a typo."""
    if isinstance(value, bool):
        return value
    raise ValueError(value)


SCALARS: dict[str, Callable[[Any], Any]] = {
    'boolean': _boolean,
    'float': float,
    'double': float,
    'octet': lambda value: bytes([value]),
}
NEEDED = {
    'boolean': 'true or false',
    'float': 'a number',
    'double': 'a number',
    'octet': 'a whole number from 0 to 255 (byte)',
}

Stamp = Callable[[Any], None]


def fill(message: Any, values: dict[str, Any]) -> list[Stamp]:
    """
    Set the fields of a message.

    Parameters
    ----------
    message
        The message, which is changed.
    values
        The values by field name, as YAML gives them; `auto` for a header and `now` for a time are
        stamps.

    Returns
    -------
    list of Stamp
        Functions that set the stamps to a time, a builtin_interfaces/msg/Time.

    Raises
    ------
    AttributeError
        There is no such field.
    TypeError, ValueError, AssertionError
        A value does not fit its field.
    UnknownType
        The type of an array's elements is not installed.

    """
    stamps: list[Stamp] = []
    types = message.get_fields_and_field_types()
    for name, value in values.items():
        current = getattr(message, name)
        stamp = _stamp(message, name, types[name], value)
        if stamp:
            stamps.append(stamp)
        elif hasattr(current, 'get_fields_and_field_types'):
            stamps += fill(current, _mapping(name, value))
        else:
            setattr(message, name, _cast(name, types[name], value))
    return stamps


def _stamp(message: Any, name: str, field_type: str, value: Any) -> Stamp | None:
    if (field_type, value) == (HEADER, 'auto'):
        return lambda now: setattr(getattr(message, name), 'stamp', now)
    if (field_type, value) == (TIME, 'now'):
        return lambda now: setattr(message, name, now)
    return None


def _cast(name: str, field_type: str, value: Any) -> Any:
    if not field_type.startswith('sequence<') and not field_type.endswith(']'):
        return _scalar(name, field_type, value)
    if not isinstance(value, list):
        raise TypeError(f"'{name}' needs a list, for example [1, 2], but got {value!r}")
    _check_length(name, field_type, len(value))
    return [_element(name, element_type(field_type), item) for item in value]


def _check_length(name: str, field_type: str, length: int) -> None:
    """Validate a length against types such as `double[9]` and `sequence<double, 3>`."""
    exact = re.fullmatch(r'.*\[(\d+)\]', field_type)
    if exact and length != int(exact[1]):
        raise ValueError(f"'{name}' needs {exact[1]} elements, but got {length}")
    most = re.fullmatch(r'sequence<.*, (\d+)>', field_type)
    if most and length > int(most[1]):
        raise ValueError(f"'{name}' takes at most {most[1]} elements, but got {length}")


def _element(name: str, type_name: str, value: Any) -> Any:
    if '/' not in type_name:
        return _scalar(name, type_name, value)
    element = get_message(type_name)()
    fill(element, _mapping(name, value))
    return element


def _scalar(name: str, type_name: str, value: Any) -> Any:
    try:
        return _cast_scalar(type_name, value)
    except (TypeError, ValueError, OverflowError) as error:
        raise ValueError(f"'{name}' needs {_needed(type_name)}, but got {value!r}") from error


def _cast_scalar(type_name: str, value: Any) -> Any:
    if value is None or isinstance(value, (dict, list)):
        raise TypeError(value)
    if _is_text(type_name):
        return str(value)
    if type_name in SCALARS:
        return SCALARS[type_name](value)
    lowest, highest = _limits(type_name)
    number = int(value)
    is_whole = not isinstance(value, float) or value.is_integer()
    if not is_whole or not lowest <= number <= highest:
        raise ValueError(value)
    return number


def _needed(type_name: str) -> str:
    if _is_text(type_name):
        return 'a string'
    if type_name in NEEDED:
        return NEEDED[type_name]
    lowest, highest = _limits(type_name)
    return f'a whole number from {lowest} to {highest} ({type_name})'


def _is_text(type_name: str) -> bool:
    return type_name.startswith(('string', 'wstring'))


def _limits(type_name: str) -> tuple[int, int]:
    """Return the minimum and maximum of a type such as `int8` or `uint64`."""
    bits = int(type_name.rpartition('int')[2])
    if type_name.startswith('u'):
        return 0, 2**bits - 1
    return -(2 ** (bits - 1)), 2 ** (bits - 1) - 1


def _mapping(name: str, value: Any) -> dict[str, Any]:
    if isinstance(value, dict):
        return value
    raise TypeError(f"'{name}' needs a mapping, for example {{x: 1}}, but got {value!r}")
