# SPDX-License-Identifier: Apache-2.0
"""Field types in the notation of ROS interfaces, such as `sequence<double>`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
import re

__all__ = ['Schema', 'element_type', 'is_message', 'is_number', 'is_text']

Schema = Callable[[str], Mapping[str, str]]
"""Returns the fields of a message type with their types, in order."""
NUMBERS = (
    {'double', 'float', 'boolean', 'octet', 'char', 'long double'}
    | {f'int{bits}' for bits in (8, 16, 32, 64)}
    | {f'uint{bits}' for bits in (8, 16, 32, 64)}
)
LIST = re.compile(r'sequence<(?P<sequence>.+?)(?:, *\d+)?>|(?P<array>.+)\[\d*\]')


def element_type(kind: str) -> str | None:
    """
    Return the element type of an array or sequence type.

    Parameters
    ----------
    kind
        The type of a field, for example `sequence<double>` or `double[9]`.

    Returns
    -------
    str or None
        For example `double`; None if the type is neither.

    """
    found = LIST.fullmatch(kind)
    return None if found is None else found['sequence'] or found['array']


def is_number(kind: str) -> bool:
    """
    Check whether a type is numeric, including boolean and byte types.

    Parameters
    ----------
    kind
        The type of a field.

    """
    return kind in NUMBERS


def is_text(kind: str) -> bool:
    """
    Check whether a type is a string type; arrays of strings are not.

    Parameters
    ----------
    kind
        The type of a field.

    """
    return kind.startswith(('string', 'wstring')) and element_type(kind) is None


def is_message(kind: str) -> bool:
    """
    Check whether a type is a message type, with fields of its own.

    Parameters
    ----------
    kind
        The type of a field.

    """
    return '/' in kind and element_type(kind) is None
