# SPDX-License-Identifier: Apache-2.0
"""Format values as YAML that every parser reads in the same way."""

from __future__ import annotations

from collections.abc import Mapping
import math
from typing import Any


def flow_text(value: Any) -> str:
    """
    Format a scalar or a list as single-line YAML; strings are always quoted.

    Parameters
    ----------
    value
        A bool, int, float, str or bytes, or a list of those.

    """
    if isinstance(value, bool):
        return 'true' if value else 'false'
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return _float_text(value)
    if isinstance(value, str):
        return _quoted(value)
    if isinstance(value, bytes):
        import base64

        return f"!!binary '{base64.b64encode(value).decode()}'"
    return f'[{", ".join(flow_text(item) for item in value)}]'


def parameter_file_text(node_name: str, parameters: Mapping[str, Any]) -> str:
    """
    Format parameters as the text of a parameter file.

    Parameters
    ----------
    node_name
        The fully qualified name of the target nodes, or `/**` for all nodes.
    parameters : Mapping[str, Any]
        Plain values by parameter name.

    """
    lines = [f'{_quoted(node_name)}:', '  ros__parameters:']
    lines += [f'    {_quoted(name)}: {flow_text(parameters[name])}' for name in sorted(parameters)]
    return '\n'.join(lines) + '\n'


def _float_text(value: float) -> str:
    if math.isnan(value):
        return '.nan'
    if math.isinf(value):
        return '.inf' if value > 0 else '-.inf'
    mantissa, exponent_mark, exponent = repr(value).partition('e')
    point = '' if '.' in mantissa else '.0'
    sign = '+' if exponent_mark and exponent[0].isdigit() else ''
    return f'{mantissa}{point}{exponent_mark}{sign}{exponent}'


def _quoted(text: str) -> str:
    """Quote a string, with escapes if it has special characters."""
    if text.isprintable():
        return "'" + text.replace("'", "''") + "'"
    import json

    return (
        json.dumps(text, ensure_ascii=False)
        .replace('\x7f', '\\x7f')
        .replace('\x85', '\\x85')
        .replace('\u2028', '\\u2028')
        .replace('\u2029', '\\u2029')
    )
