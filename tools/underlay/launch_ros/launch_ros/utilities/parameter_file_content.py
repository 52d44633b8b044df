# SPDX-License-Identifier: Apache-2.0
"""Read what a parameter file says about nodes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
import re
from typing import Any

from launch.utilities._scalars import EXPONENT
from launch_ros.utilities.parameter_values import checked

_PARAMETERS = 'ros__parameters'
_WILDCARDS = {'*': '/[^/]+', '**': '(?:/[^/]+)*'}


@dataclass(frozen=True)
class ParameterFileContent:
    """What a file holds: parameters for names of nodes, and what is for none."""

    path: str
    sections: list[tuple[str, Mapping[Any, Any]]]
    """The names, which may have wildcards, and what is below their `ros__parameters`."""
    stray_keys: list[str]
    """The paths of values that lie outside any `ros__parameters` and so have no effect."""

    def parameters_of(self, node_name: str) -> list[tuple[str, Any]]:
        """
        Return the parameters for a node, in the order of the file.

        Parameters
        ----------
        node_name
            The full name of the node, such as `/front/camera`.

        Returns
        -------
        list of tuple
            Names, with those of nested parameters joined by dots, and values.

        Raises
        ------
        TypeError
            A parameter cannot have the value that the file gives it.

        """
        found: list[tuple[str, Any]] = []
        for pattern, parameters in self.sections:
            if matches(pattern, node_name):
                found += _flat(parameters, '', self.path)
        return found


def read_parameter_file(path: str) -> ParameterFileContent:
    """
    Read a YAML file of parameters.

    Parameters
    ----------
    path
        The file.

    Raises
    ------
    FileNotFoundError
        There is no such file; the text says what may have been meant.
    ValueError
        The file is not YAML, or does not map names of nodes to parameters.

    """
    content = ParameterFileContent(path, [], [])
    tree = _load(path)
    if not isinstance(tree, Mapping):
        raise ValueError(_misfit(path, '/', tree))
    _collect(tree, '', content)
    return content


def matches(pattern: str, node_name: str) -> bool:
    """
    Whether a key of a parameter file stands for a node.

    Parameters
    ----------
    pattern
        The key: `*` stands for one part of a name, `**` for any number of them.
    node_name
        The full name of the node.

    """
    parts = [part for part in pattern.split('/') if part]
    expression = ''.join(_WILDCARDS.get(part, '/' + re.escape(part)) for part in parts)
    return re.fullmatch(expression, node_name) is not None


def _load(path: str) -> Any:
    import yaml

    try:
        with open(path, encoding='utf-8') as file:
            return yaml.load(file, _loader()) or {}  # noqa: S506  (it is a SafeLoader)
    except FileNotFoundError as error:
        from launch._missing_file import explain_missing_file

        raise FileNotFoundError(explain_missing_file('parameter file', path)) from error
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


def _collect(tree: Mapping[Any, Any], prefix: str, content: ParameterFileContent) -> None:
    """Add what is below a name, which may be a nested namespace."""
    for key, value in tree.items():
        where = f'{prefix}/{str(key).lstrip("/")}'
        if key == _PARAMETERS:
            if not isinstance(value or {}, Mapping):
                raise ValueError(_misfit(content.path, where, value))
            content.sections.append((prefix, value or {}))
        elif isinstance(value, Mapping):
            _collect(value, where, content)
        else:
            content.stray_keys.append(where)


def _misfit(path: str, where: str, value: Any) -> str:
    return (
        f"the parameter file '{path}' must have names of nodes, below them '{_PARAMETERS}', and "
        f"below that the parameters, but below '{where}' there is {value!r}"
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
