# SPDX-License-Identifier: Apache-2.0
"""Hints why a node may reject a value."""

from __future__ import annotations

from typing import Any

from rcl_interfaces.msg import ParameterValue
from ros2param.api import get_parameters, unknown_parameter_hint
from ros2param.api.values import to_plain_value, type_name, TYPES


def refusal_hint(node: Any, node_name: str, name: str, value: ParameterValue, reason: str) -> str:
    """
    Explain why a node may have rejected a parameter value: unknown name or wrong type.

    Parameters
    ----------
    node
        The `DirectNode` that calls.
    node_name
        Full name of the node.
    name, value
        The parameter, and the value that was rejected.
    reason
        The node's own reason; types are only compared if it contains the word "type".

    Returns
    -------
    str
        The hint, with the way to write the value if that helps, or ''.

    """
    current = get_parameters(node, node_name, [name])[0]
    if current.type not in TYPES:
        return unknown_parameter_hint(node, node_name, name)
    if current.type == value.type or 'type' not in reason:
        return ''
    wanted, given = type_name(current.type), type_name(value.type)
    plain = to_plain_value(value)
    text = f"'{name}' is of the type {wanted}, but {plain!r} is {given}."
    if (wanted, given) == ('double', 'integer'):
        return f'{text} Write {float(plain)}.'
    if (wanted, given) == ('double array', 'integer array'):
        return f'{text} Write {[float(item) for item in plain]}.'
    if wanted == 'string':
        return f"{text} Quotes make it a string: '...' in a file, \"'...'\" in a terminal."
    return text
