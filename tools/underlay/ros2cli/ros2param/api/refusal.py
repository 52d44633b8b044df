# SPDX-License-Identifier: Apache-2.0
"""Why a node may refuse a value."""

from __future__ import annotations

import argparse
from typing import Any

from rcl_interfaces.msg import ParameterValue
from ros2param.api import get_parameters, unknown_parameter_hint
from ros2param.api.values import type_name, TYPES


def refusal_hint(
    node: Any, node_name: str, args: argparse.Namespace, value: ParameterValue, reason: str
) -> str:
    """Return what is wrong with a parameter's name, or with the type that a node refuses."""
    current = get_parameters(node, node_name, [args.parameter_name])[0]
    if current.type not in TYPES:
        return unknown_parameter_hint(node, node_name, args.parameter_name)
    if current.type == value.type or 'type' not in reason:
        return ''
    wanted, given = type_name(current.type), type_name(value.type)
    text = f"'{args.parameter_name}' is of the type {wanted}, but {args.value!r} is {given}."
    if (wanted, given) == ('double', 'integer'):
        return f'{text} Write {float(value.integer_value)}.'
    if wanted == 'string':
        return f'{text} Put it in two kinds of quotes: "\'{args.value}\'"'
    return text
