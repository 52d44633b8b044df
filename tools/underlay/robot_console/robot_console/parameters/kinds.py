# SPDX-License-Identifier: Apache-2.0
"""The types of parameters by name."""

from __future__ import annotations

__all__ = ['BOOLEAN', 'BYTE_ARRAY', 'DOUBLE', 'INTEGER', 'NOT_SET', 'STRING', 'item_kind']

BOOLEAN, INTEGER, DOUBLE, STRING = 'boolean', 'integer', 'double', 'string'
BYTE_ARRAY, NOT_SET = 'byte array', 'not set'
ARRAY = ' array'


def item_kind(kind: str) -> str:
    """
    Get the type of the items of an array type.

    Parameters
    ----------
    kind
        The name of the type, such as `double array`.

    Returns
    -------
    str
        Such as `double`; '' if it is no array.

    """
    return kind.removesuffix(ARRAY) if kind.endswith(ARRAY) else ''
