# SPDX-License-Identifier: Apache-2.0
"""Conversion of parameter values to and from plain values and text."""

from __future__ import annotations

from typing import Any, NamedTuple

from rcl_interfaces.msg import ParameterType, ParameterValue
import yaml


class ValueType(NamedTuple):
    """Name of a parameter type, and the field with its value."""

    name: str
    label: str
    field: str


TYPES = {
    ParameterType.PARAMETER_BOOL: ValueType('boolean', 'Boolean value is:', 'bool_value'),
    ParameterType.PARAMETER_INTEGER: ValueType('integer', 'Integer value is:', 'integer_value'),
    ParameterType.PARAMETER_DOUBLE: ValueType('double', 'Double value is:', 'double_value'),
    ParameterType.PARAMETER_STRING: ValueType('string', 'String value is:', 'string_value'),
    ParameterType.PARAMETER_BYTE_ARRAY: ValueType(
        'byte array', 'Byte values are:', 'byte_array_value'
    ),
    ParameterType.PARAMETER_BOOL_ARRAY: ValueType(
        'boolean array', 'Boolean values are:', 'bool_array_value'
    ),
    ParameterType.PARAMETER_INTEGER_ARRAY: ValueType(
        'integer array', 'Integer values are:', 'integer_array_value'
    ),
    ParameterType.PARAMETER_DOUBLE_ARRAY: ValueType(
        'double array', 'Double values are:', 'double_array_value'
    ),
    ParameterType.PARAMETER_STRING_ARRAY: ValueType(
        'string array', 'String values are:', 'string_array_value'
    ),
}
SCALAR_TYPES = {
    bool: ParameterType.PARAMETER_BOOL,
    int: ParameterType.PARAMETER_INTEGER,
    float: ParameterType.PARAMETER_DOUBLE,
    str: ParameterType.PARAMETER_STRING,
}
ARRAY_TYPES = {
    bool: ParameterType.PARAMETER_BOOL_ARRAY,
    int: ParameterType.PARAMETER_INTEGER_ARRAY,
    float: ParameterType.PARAMETER_DOUBLE_ARRAY,
    str: ParameterType.PARAMETER_STRING_ARRAY,
}
LARGEST_INTEGER = 2**63


def type_name(kind: int) -> str:
    """
    Return the name of a parameter type, such as `double array`.

    Parameters
    ----------
    kind
        A constant of `rcl_interfaces/msg/ParameterType`.

    Returns
    -------
    str
        The name; `not set` for `PARAMETER_NOT_SET` and unknown constants.

    """
    return TYPES[kind].name if kind in TYPES else 'not set'


def to_plain_value(value: ParameterValue) -> Any:
    """
    Convert a parameter value to a plain Python value.

    Parameters
    ----------
    value
        The value, of any type.

    Returns
    -------
    bool, int, float, str, list or None
        Arrays become lists; None if the value is not set.

    """
    if value.type not in TYPES:
        return None
    plain = getattr(value, TYPES[value.type].field)
    return plain if isinstance(plain, (bool, int, float, str)) else list(plain)


def parse_value(text: str) -> ParameterValue:
    """
    Parse a YAML string as a parameter value.

    Parameters
    ----------
    text
        The value as the user wrote it.

    Returns
    -------
    ParameterValue
        The value; a string parameter with the whole text if it is not YAML or fits no other type.

    Raises
    ------
    RuntimeError
        An integer needs more than 64 bits.

    """
    try:
        plain = yaml.safe_load(text)
    except yaml.YAMLError:
        plain = text
    return to_value(plain, text)


def to_value(plain: Any, text: str) -> ParameterValue:
    """
    Convert a plain Python value to a parameter value.

    Lists of integers and floats become double arrays, and an empty list a boolean array.

    Parameters
    ----------
    plain
        The value: bool, int, float, str, or a list of these.
    text
        The string parameter that it becomes if it is of any other type, such as a mixed list.

    Raises
    ------
    RuntimeError
        An integer needs more than 64 bits.

    """
    items = plain if isinstance(plain, list) else [plain]
    kinds = {type(item) for item in items}
    if kinds == {int, float}:
        _check_range(items)
        items, kinds = [float(item) for item in items], {float}
    kind = kinds.pop() if len(kinds) == 1 else bool
    if kinds or kind not in SCALAR_TYPES:
        return ParameterValue(type=ParameterType.PARAMETER_STRING, string_value=text)
    _check_range(items)
    if isinstance(plain, list):
        return _value(ARRAY_TYPES[kind], items)
    return _value(SCALAR_TYPES[kind], plain)


def _value(kind: int, plain: Any) -> ParameterValue:
    value = ParameterValue(type=kind)
    setattr(value, TYPES[kind].field, plain)
    return value


def _check_range(items: list[Any]) -> None:
    for item in items:
        if isinstance(item, int) and not -LARGEST_INTEGER <= item < LARGEST_INTEGER:
            raise RuntimeError(f'{item} is too large: an integer parameter has 64 bits')
