# SPDX-License-Identifier: Apache-2.0
"""Read YAML files as tables that know the line of each value."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from humanoid_common.tables.source_location import SourceLocation, TableError
from humanoid_common.tables.table import Table
import yaml


def load_table(path: Path) -> Table:
    """
    Load a YAML file as a table.

    Parameters
    ----------
    path
        Path of the file.

    Raises
    ------
    TableError
        It cannot be read, is not YAML in UTF-8, or its top level is not a table.

    """
    try:
        if path.exists() and not path.is_file():  # a pipe would block
            found = 'folder' if path.is_dir() else 'device'
            raise TableError(f'{path} is a {found}. Give the path of a YAML file.')
        text = path.read_text(encoding='utf-8')
    except OSError as error:
        raise TableError(f'{path} cannot be read: {error.strerror}.') from error
    except (UnicodeDecodeError, ValueError) as error:
        raise TableError(f'{path} is not a valid YAML file: {error}') from error
    return table_of(text, str(path))


def table_of(text: str, source: str) -> Table:
    """
    Parse a YAML text as a table.

    Parameters
    ----------
    text
        Content of a file.
    source
        What error messages call it, such as the path of the file.

    Raises
    ------
    TableError
        It is not YAML, or its top level is not a table.

    """
    try:
        content = read_lines(text)
    except yaml.MarkedYAMLError as error:
        raise TableError(f'{source} is not a valid YAML file{_problem(error)}.') from error
    except (yaml.YAMLError, RecursionError, ValueError) as error:  # such as a date in month 13
        problem = str(error).splitlines()[0]
        raise TableError(f'{source} is not a valid YAML file: {problem}.') from error
    return Table(content, SourceLocation(source, 1))


def _problem(error: yaml.MarkedYAMLError) -> str:
    """Describe in one line what is wrong with a text, and where."""
    mark = error.problem_mark
    where = f' (line {mark.line + 1}, column {mark.column + 1})' if mark else ''
    hint = '. Indent with spaces instead' if error.problem and r"'\t'" in error.problem else ''
    return f'{where}: {error.problem}{hint}' if error.problem else where


class LinedTable(dict[str, Any]):
    """A table with its line number, and those of its values, counted from 1."""

    line: int
    lines: dict[str, int]


class _Loader(yaml.SafeLoader):
    """Loader of tables with line numbers; a duplicate key is rejected."""


def _construct_table(loader: _Loader, node: yaml.MappingNode) -> Any:
    """Yield a table, and then fill it, as PyYAML requires for recursive structures."""
    table = LinedTable()
    table.line, table.lines = node.start_mark.line + 1, {}
    yield table
    for key_node, _ in node.value:
        key = str(key_node.value)
        if key in table.lines:
            raise yaml.constructor.ConstructorError(
                None,
                None,
                f"duplicate key '{key}', also on line {table.lines[key]}: remove one of them",
                key_node.start_mark,
            )
        table.lines[key] = key_node.start_mark.line + 1
    loader.flatten_mapping(node)
    values: dict[Any, Any] = loader.construct_mapping(node, deep=True)
    table.update(values)


_Loader.add_constructor(yaml.resolver.BaseResolver.DEFAULT_MAPPING_TAG, _construct_table)


def read_lines(text: str) -> Any:
    """
    Parse a YAML text, and keep the line numbers of tables and their values.

    Parameters
    ----------
    text
        The text.

    Returns
    -------
    Any
        Its content, in which each table is a `LinedTable`.

    Raises
    ------
    YAMLError
        It is not YAML, or a table has a duplicate key.

    """
    return yaml.load(text, Loader=_Loader)  # noqa: S506 - it is a SafeLoader
