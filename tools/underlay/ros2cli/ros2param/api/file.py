# SPDX-License-Identifier: Apache-2.0
"""The parameters that a file has for a node."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
import re
from typing import Any

from rcl_interfaces.msg import ParameterValue
from ros2param.api.nesting import flatten
from ros2param.api.values import to_value
import yaml

PARAMETERS = 'ros__parameters'
WILDCARD = '*'


def read_parameters(
    path: str, node_name: str, *, use_wildcard: bool = True
) -> dict[str, ParameterValue]:
    """Return a node's parameters; what a file says for many nodes gives way to its own."""
    sections = dict(_sections(_read(path), ''))
    exact = [name for name in sections if name == node_name]
    general = [name for name in sections if WILDCARD in name and matches(name, node_name)]
    chosen = [*(general if use_wildcard else ()), *exact]
    if not chosen:
        raise RuntimeError(
            f"Param file '{path}' does not contain parameters for {node_name}, only for nodes: "
            f'{sorted(sections)}'
        )
    plain = {name: value for key in chosen for name, value in flatten(sections[key])}
    return {name: to_value(value, str(value)) for name, value in plain.items()}


def matches(pattern: str, node_name: str) -> bool:
    """Tell if a name with `*` for one part and `**` for any number of parts fits a node."""
    tokens = {'*': '/[^/]+', '**': '(/[^/]+)*'}
    parts = pattern.strip('/').split('/')
    expression = ''.join(tokens.get(part, f'/{re.escape(part)}') for part in parts)
    return re.fullmatch(expression, node_name) is not None


def _read(path: str) -> Mapping[Any, Any]:
    try:
        with open(path, encoding='utf-8') as stream:
            document = yaml.safe_load(stream)
    except (OSError, UnicodeDecodeError) as error:
        raise RuntimeError(f"The parameter file '{path}' cannot be read: {error}") from error
    except yaml.YAMLError as error:
        raise RuntimeError(f"The parameter file '{path}' is no YAML: {error}") from error
    if not isinstance(document, Mapping):
        raise RuntimeError(f"The parameter file '{path}' has no names of nodes")
    return document


def _sections(document: Mapping[Any, Any], prefix: str) -> Iterator[tuple[str, Mapping[Any, Any]]]:
    """Yield the full names of nodes with their parameters; namespaces may be nested."""
    for key, value in document.items():
        name = f'{prefix}/{str(key).strip("/")}'
        if not isinstance(value, Mapping):
            raise RuntimeError(
                f"In a parameter file '{name}' needs a mapping with '{PARAMETERS}', but has "
                f'{value!r}'
            )
        if PARAMETERS in value:
            yield name, value[PARAMETERS] or {}
        else:
            yield from _sections(value, name)
