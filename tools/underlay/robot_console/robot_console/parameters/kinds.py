# SPDX-License-Identifier: Apache-2.0
"""The types of parameters by name."""

from __future__ import annotations

__all__ = ['BOOLEAN', 'BYTE_ARRAY', 'DOUBLE', 'INTEGER', 'NOT_SET', 'STRING', 'item_kind']

BOOLEAN, INTEGER, DOUBLE, STRING = 'boolean', 'integer', 'double', 'string'
BYTE_ARRAY, NOT_SET = 'byte array', 'not set'
ARRAY = ' array'


def item_kind(kind: str) -> str:
    """Return the type of the items of an array, or '' if it is no array."""
    return kind.removesuffix(ARRAY) if kind.endswith(ARRAY) else ''
