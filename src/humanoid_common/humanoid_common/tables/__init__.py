# SPDX-License-Identifier: Apache-2.0
"""YAML files as checked tables: a mistake is a message with the file, the line and the key."""

from __future__ import annotations

from humanoid_common.tables.source_location import SourceLocation, TableError
from humanoid_common.tables.table import is_number, is_vector, Table
from humanoid_common.tables.yaml_lines import load_table, table_of

__all__ = [
    'SourceLocation',
    'Table',
    'TableError',
    'is_number',
    'is_vector',
    'load_table',
    'table_of',
]
