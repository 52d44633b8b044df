# SPDX-License-Identifier: Apache-2.0
"""Read what a parameter file says about a node."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache
import re
from typing import Any

from launch.utilities._scalars import EXPONENT
from launch_ros.utilities.parameter_values import checked

_PARAMETERS = 'ros__parameters'
_WILDCARDS = {'*': '/[^/]+', '**': '(?:/[^/]+)*'}


def read_parameter_file(path: str, node_name: str) -> list[tuple[str, Any]]:
    """Return the parameters that a file has for the node of this full name, in its order."""
    found: list[tuple[str, Any]] = []
    for pattern, parameters in _sections(_load(path), '', path):
        if matches(pattern, node_name):
            found += _flat(parameters, '', path)
    return found


def matches(pattern: str, node_name: str) -> bool:
    """Return whether a key stands for a node: `*` for one part of a name, `**` for any number."""
    parts = [part for part in pattern.split('/') if part]
    expression = ''.join(_WILDCARDS.get(part, '/' + re.escape(part)) for part in parts)
    return re.fullmatch(expression, node_name) is not None


def _load(path: str) -> Any:
    import yaml

    try:
        with open(path, encoding='utf-8') as file:
            return yaml.load(file, _loader()) or {}  # noqa: S506  (it is a SafeLoader)
    except yaml.YAMLError as error:
        raise ValueError(f"the parameter file '{path}' is not valid YAML: {error}") from error


@cache
def _loader() -> Any:
    """Return a class that reads numbers such as 1e-3, which YAML 1.1 takes for texts, as ROS."""
    import yaml

    class Loader(yaml.SafeLoader):
        pass

    number = re.compile(f'(?:{EXPONENT.pattern})$')
    Loader.add_implicit_resolver('tag:yaml.org,2002:float', number, list('-+.0123456789'))
    return Loader


def _sections(tree: Any, prefix: str, path: str) -> Iterator[tuple[str, Any]]:
    """Yield the parameters below each name, which may be nested namespaces."""
    for key, value in _mapping(tree, prefix, path).items():
        if key == _PARAMETERS:
            yield prefix, _mapping(value or {}, f'{prefix}/{key}', path)
        else:
            yield from _sections(value, f'{prefix}/{key}', path)


def _mapping(value: Any, where: str, path: str) -> Mapping[Any, Any]:
    if isinstance(value, Mapping):
        return value
    raise ValueError(
        f"the parameter file '{path}' must have names of nodes, below them '{_PARAMETERS}', and "
        f"below that the parameters, but below '{where or '/'}' there is {value!r}"
    )


def _flat(parameters: Mapping[Any, Any], prefix: str, path: str) -> Iterator[tuple[str, Any]]:
    """Yield each parameter; the names of nested ones are joined by dots."""
    for key, value in parameters.items():
        name = f'{prefix}{key}'
        if isinstance(value, Mapping):
            yield from _flat(value, f'{name}.', path)
            continue
        try:
            yield name, checked(value, name)
        except TypeError as error:
            raise TypeError(f"in the parameter file '{path}': {error}") from error
