# SPDX-License-Identifier: Apache-2.0
"""Names of the parameter types."""

from __future__ import annotations

__all__ = ['BOOLEAN', 'BYTE_ARRAY', 'DOUBLE', 'INTEGER', 'NOT_SET', 'STRING', 'item_kind']

BOOLEAN, INTEGER, DOUBLE, STRING = 'boolean', 'integer', 'double', 'string'
BYTE_ARRAY, NOT_SET = 'byte array', 'not set'
ARRAY = ' array'


def item_kind(kind: str) -> str:
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
