# SPDX-License-Identifier: Apache-2.0
"""Parameter files: reading them, and the nesting of dotted names in them."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
import re
from typing import Any

from rcl_interfaces.msg import ParameterValue
from ros2param.api.values import to_value
import yaml

PARAMETERS = 'ros__parameters'
WILDCARD = '*'
SEPARATOR = '.'


def read_parameters(
    path: str, node_name: str, *, use_wildcard: bool = True
) -> dict[str, ParameterValue]:
    """
    Read a node's parameters from a YAML parameter file.

    Later sections with wildcards in their names override earlier ones, and the section that names
    the node itself overrides them all.

    Parameters
    ----------
    path
        The parameter file.
    node_name
        Full name of the node.
    use_wildcard
        Whether sections with wildcards in their names apply, too.

    Returns
    -------
    dict of str to ParameterValue
        The values by the dotted names of the parameters.

    Raises
    ------
    RuntimeError
        The file cannot be read, has no section for this node, or a value is missing or too large.

    """
    try:
        sections = dict(_sections(_read(path), ''))
        chosen = _chosen(sections, node_name, use_wildcard=use_wildcard)
        plain = {name: value for key in chosen for name, value in flatten(sections[key])}
        return {name: _value(name, value) for name, value in plain.items()}
    except _Mistake as error:
        raise RuntimeError(f"The parameter file '{path}' {error}") from error


def matches(pattern: str, node_name: str) -> bool:
    """
    Test whether a node name matches a pattern with wildcards.

    Parameters
    ----------
    pattern
        Parts joined by slashes: `*` matches one whole part, `**` any number of parts, including
        zero. Within a part an asterisk is an ordinary character.
    node_name
        Full name of the node, with the leading slash.

    """
    tokens = {'*': '/[^/]+', '**': '(/[^/]+)*'}
    parts = pattern.strip('/').split('/')
    expression = ''.join(tokens.get(part, f'/{re.escape(part)}') for part in parts)
    return re.fullmatch(expression, node_name) is not None


class _Mistake(Exception):
    """A problem of a file, as the end of the error message."""


def _chosen(sections: Collection[str], node_name: str, *, use_wildcard: bool) -> list[str]:
    """Return the sections that apply to a node, its own last."""
    exact = [name for name in sections if name == node_name]
    general = [name for name in sections if WILDCARD in name and matches(name, node_name)]
    chosen = [*(general if use_wildcard else ()), *exact]
    if not chosen:
        raise _Mistake(
            f'does not contain parameters for {node_name}, only for nodes: {sorted(sections)}'
        )
    return chosen


def _read(path: str) -> Mapping[Any, Any]:
    try:
        with open(path, encoding='utf-8') as stream:
            document = yaml.safe_load(stream)
    except OSError as error:
        raise _Mistake(f'cannot be read: {error.strerror}') from error
    except UnicodeDecodeError as error:
        raise _Mistake(f'cannot be read: {error}') from error
    except yaml.YAMLError as error:
        raise _Mistake(f'is not valid YAML: {error}') from error
    if not isinstance(document, Mapping):
        raise _Mistake('has no node names')
    return document


def _sections(document: Mapping[Any, Any], prefix: str) -> Iterator[tuple[str, Mapping[Any, Any]]]:
    """Yield the full names of nodes with their parameters; namespaces may be nested."""
    for key, value in document.items():
        name = f'{prefix}/{str(key).strip("/")}'
        if not isinstance(value, Mapping):
            raise _Mistake(_misplaced_text(name, value))
        if PARAMETERS in value:
            yield name, _parameters(name, value[PARAMETERS])
        else:
            yield from _sections(value, name)


def _parameters(node_name: str, value: Any) -> Mapping[Any, Any]:
    if not isinstance(value, Mapping | None):
        raise _Mistake(
            f"needs names with values below '{PARAMETERS}' of '{node_name}', not {value!r}"
        )
    return value or {}


def _misplaced_text(name: str, value: Any) -> str:
    """Format the message for a value outside of the parameters, with a hint to a misspelt name."""
    text = f"has the value {value!r} for '{name}', which is not below '{PARAMETERS}'"
    misspelt = [part for part in name.split('/') if 'parameters' in part]
    return f"{text}: '{misspelt[-1]}' needs two underscores" if misspelt else text


def _value(name: str, value: Any) -> ParameterValue:
    if value is None:
        raise _Mistake(f"has no value for the parameter '{name}'")
    try:
        return to_value(value, str(value))
    except RuntimeError as error:
        raise _Mistake(f"has a wrong value for the parameter '{name}': {error}") from error


def nest(values: Mapping[str, Any]) -> dict[str, Any]:
    """
    Nest values by their dotted names: `a.b` becomes `b` within `a`.

    A name stays as it is if one of its prefixes is a parameter itself.

    Parameters
    ----------
    values
        The values by their dotted names.

    """
    root: dict[str, Any] = {}
    for name, value in values.items():
        parts = name.split(SEPARATOR)
        prefixes = {SEPARATOR.join(parts[:count]) for count in range(1, len(parts))}
        if prefixes & values.keys():
            root[name] = value
            continue
        inner = root
        for part in parts[:-1]:
            inner = inner.setdefault(part, {})
        inner[parts[-1]] = value
    return root


def flatten(nested: Mapping[Any, Any], prefix: str = '') -> Iterator[tuple[str, Any]]:
    """
    Flatten nested mappings into dotted names.

    Parameters
    ----------
    nested
        Values or mappings by name; mappings may be nested to any depth.
    prefix
        The prefix of each name, with its final dot.

    Yields
    ------
    tuple of str and Any
        A dotted name and its value.

    """
    for name, value in nested.items():
        if isinstance(value, Mapping):
            yield from flatten(value, f'{prefix}{name}{SEPARATOR}')
        else:
            yield f'{prefix}{name}', value
