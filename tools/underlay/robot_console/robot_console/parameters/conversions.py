# SPDX-License-Identifier: Apache-2.0
"""Conversion of ROS parameters to and from the format of the page."""

from __future__ import annotations

import json
from typing import Any

from rcl_interfaces.msg import ParameterDescriptor, ParameterValue
from robot_console.parameters.kinds import NOT_SET
from robot_console.parameters.typed_value import Limits, typed_value
from ros2param.api.values import parse_value, to_plain_value, type_name, TYPES

__all__ = ['described', 'parameter_value', 'value_text']

KINDS = {each.name: number for number, each in TYPES.items()}


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
        raise ValueError('It can only be set when the node is started.')
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
