# SPDX-License-Identifier: Apache-2.0
"""Read parameter files."""

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
    """The content of a parameter file: parameters by node name, and stray keys."""

    path: str
    sections: list[tuple[str, Mapping[Any, Any]]]
    """Node names, possibly with wildcards, and the mappings below their `ros__parameters`."""
    stray_keys: list[str]
    """The paths of values outside any `ros__parameters`, which have no effect."""

    def parameters_of(self, node_name: str) -> list[tuple[str, Any]]:
        """
        Return the parameters of a node, in the order of the file.

        Parameters
        ----------
        node_name
            The fully qualified name of the node, such as `/front/camera`.

        Returns
        -------
        list of tuple
            Names and values; the names of nested parameters are joined by dots.

        Raises
        ------
        TypeError
            A value in the file is not a valid parameter value.

        """
        found: list[tuple[str, Any]] = []
        for pattern, parameters in self.sections:
            if matches(pattern, node_name):
                found += _flat(parameters, '', self.path)
        return found


def read_parameter_file(path: str) -> ParameterFileContent:
    """
    Read a YAML parameter file.

    Parameters
    ----------
    path
        The file.

    Raises
    ------
    FileNotFoundError
        The file does not exist; the message suggests similar names.
    ValueError
        The file is not valid YAML, or does not map node names to parameters.

    """
    content = ParameterFileContent(path, [], [])
    tree = _load(path)
    if not isinstance(tree, Mapping):
        raise ValueError(_misfit(path, '/', tree))
    _collect(tree, '', content)
    return content


def matches(pattern: str, node_name: str) -> bool:
    """
    Whether a key of a parameter file matches a node.

    Parameters
    ----------
    pattern
        The key; `*` matches one token of a name, `**` any number of tokens.
    node_name
        The fully qualified name of the node.

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
    """Return a loader that parses numbers such as 1e-3 like ROS, not as YAML 1.1 strings."""
    import yaml

    class Loader(yaml.SafeLoader):
        pass

    number = re.compile(f'(?:{EXPONENT.pattern})$')
    Loader.add_implicit_resolver('tag:yaml.org,2002:float', number, list('-+.0123456789'))
    return Loader


def _collect(tree: Mapping[Any, Any], prefix: str, content: ParameterFileContent) -> None:
    """Collect the sections and stray keys below a name, which may be a namespace."""
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
    """Yield the parameters; nested names are joined by dots."""
    for key, value in parameters.items():
        name = f'{prefix}{key}'
        if isinstance(value, Mapping):
            yield from _flat(value, f'{name}.', path)
            continue
        try:
            yield name, checked(value, name)
        except TypeError as error:
            raise TypeError(f"in the parameter file '{path}': {error}") from error
