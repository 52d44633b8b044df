# SPDX-License-Identifier: Apache-2.0
"""Substitutions that rewrite a parameter file to a temporary copy, deleted after the launch."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Optional

from launch.conditions import Condition
from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType, Substitution
from launch.substitutions import SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from ros_environment.temporary_files import write_temporary_file
import yaml

__all__ = ['HasNodeParams', 'ReplaceString', 'RewrittenYaml']

_Texts = Mapping[SomeSubstitutionsType, SomeSubstitutionsType]


class RewrittenYaml(Substitution):
    """
    Stands for the path of a copy of a YAML file in which values, or keys, are others.

    Parameters
    ----------
    source_file
        The path of the file.
    param_rewrites
        New values by names. A name without dots, or the end of a path, changes each matching
        value; a whole path such as `amcl.ros__parameters.use_sim_time` changes the value there, or
        adds it.
    root_key
        A key to nest the whole file below, such as the namespace of a robot; may be empty.
    key_rewrites
        New keys by old ones.
    convert_types
        Whether new values that parse as numbers or booleans are converted.
    value_rewrites
        New values by old ones, anywhere in the file.

    """

    def __init__(
        self,
        source_file: SomeSubstitutionsType,
        param_rewrites: _Texts,
        root_key: Optional[SomeSubstitutionsType] = None,
        key_rewrites: Optional[_Texts] = None,
        convert_types: bool = False,
        value_rewrites: Optional[_Texts] = None,
    ) -> None:
        super().__init__()
        self.__source_file = normalize_to_list_of_substitutions(source_file)
        self.__param_rewrites = _parts(param_rewrites)
        self.__key_rewrites = _parts(key_rewrites or {})
        self.__value_rewrites = _parts(value_rewrites or {})
        self.__root_key = (
            None if root_key is None else normalize_to_list_of_substitutions(root_key)
        )
        self.__convert_types = convert_types

    @property
    def name(self) -> list[Substitution]:
        """Return the parts of the path of the file."""
        return self.__source_file

    def describe(self) -> str:
        """Return a short description for people."""
        return f'RewrittenYaml({" + ".join(sub.describe() for sub in self.__source_file)})'

    def perform(self, context: LaunchContext) -> str:
        """
        Write the copy, and return its path.

        Parameters
        ----------
        context
            The context in which the path, names and values are performed.

        Raises
        ------
        SubstitutionFailure
            The file cannot be read, is not YAML, or is not a mapping at the top level.

        """
        data = _read(perform_substitutions(context, self.__source_file))
        values = {
            name: self._converted(text)
            for name, text in _performed(context, self.__param_rewrites).items()
        }
        data = _with_values(data, values)
        for path, value in values.items():
            if '.' in path:
                _add(data, path.split('.'), value)
        data = _with_keys(data, _performed(context, self.__key_rewrites))
        olds = _performed(context, self.__value_rewrites)
        data = _with_new_values(data, {old: self._converted(new) for old, new in olds.items()})
        root = perform_substitutions(context, self.__root_key) if self.__root_key else ''
        if root:
            data = {root: data}
        return write_temporary_file('rewritten_', yaml.safe_dump(data, sort_keys=False))

    def _converted(self, text: str) -> Any:
        if not self.__convert_types:
            return text
        for kind in (int, float):
            try:
                return kind(text)
            except ValueError:
                continue
        return {'true': True, 'false': False}.get(text.lower(), text)


class ReplaceString(Substitution):
    """
    Stands for the path of a copy of a file in which texts are replaced.

    Parameters
    ----------
    source_file
        The path of the file.
    replacements
        New texts by old ones.
    condition
        If omitted or true, texts are replaced; otherwise the original file is used.

    """

    def __init__(
        self,
        source_file: SomeSubstitutionsType,
        replacements: _Texts,
        condition: Optional[Condition] = None,
    ) -> None:
        super().__init__()
        self.__source_file = normalize_to_list_of_substitutions(source_file)
        self.__replacements = _parts(replacements)
        self.__condition = condition

    @property
    def name(self) -> list[Substitution]:
        """Return the parts of the path of the file."""
        return self.__source_file

    @property
    def condition(self) -> Optional[Condition]:
        """Return the condition."""
        return self.__condition

    def describe(self) -> str:
        """Return a short description for people."""
        return f'ReplaceString({" + ".join(sub.describe() for sub in self.__source_file)})'

    def perform(self, context: LaunchContext) -> str:
        """
        Write the copy, and return its path.

        If the condition is false, return the path of the original file.

        Parameters
        ----------
        context
            The context in which the path, the texts and the condition are evaluated.

        Raises
        ------
        SubstitutionFailure
            The file cannot be read.

        """
        path = perform_substitutions(context, self.__source_file)
        if self.__condition is not None and not self.__condition.evaluate(context):
            return path
        text = _text(path)
        for old, new in _performed(context, self.__replacements).items():
            text = text.replace(old, new)
        return write_temporary_file('replaced_', text)


class HasNodeParams(Substitution):
    """
    Stands for `True` if a file of parameters has some for a node, and else for `False`.

    Parameters
    ----------
    source_file
        The path of the file.
    node_name
        The name of the node.

    """

    def __init__(
        self, source_file: SomeSubstitutionsType, node_name: SomeSubstitutionsType
    ) -> None:
        super().__init__()
        self.__source_file = normalize_to_list_of_substitutions(source_file)
        self.__node_name = normalize_to_list_of_substitutions(node_name)

    @property
    def name(self) -> list[Substitution]:
        """Return the parts of the path of the file."""
        return self.__source_file

    def describe(self) -> str:
        """Return a short description for people."""
        return f'HasNodeParams({" + ".join(sub.describe() for sub in self.__source_file)})'

    def perform(self, context: LaunchContext) -> str:
        """
        Return `True` if the file has parameters for the node, else `False`, as a text.

        Parameters
        ----------
        context
            The context in which the path and the name are performed.

        Raises
        ------
        SubstitutionFailure
            The file cannot be read, is not YAML, or is not a mapping at the top level.

        """
        data = _read(perform_substitutions(context, self.__source_file))
        name = perform_substitutions(context, self.__node_name)
        return str(isinstance(data, dict) and name in data)


_Parts = list[tuple[list[Substitution], list[Substitution]]]


def _parts(texts: _Texts) -> _Parts:
    """Convert keys and values to substitutions."""
    return [
        (normalize_to_list_of_substitutions(key), normalize_to_list_of_substitutions(value))
        for key, value in texts.items()
    ]


def _performed(context: LaunchContext, parts: _Parts) -> dict[str, str]:
    return {
        perform_substitutions(context, key): perform_substitutions(context, value)
        for key, value in parts
    }


def _text(path: str) -> str:
    try:
        return Path(path).read_text(encoding='utf-8')
    except (OSError, UnicodeDecodeError) as error:
        raise SubstitutionFailure(f"The file '{path}' cannot be read: {error}") from error


def _read(path: str) -> Any:
    try:
        data = yaml.safe_load(_text(path))
    except yaml.YAMLError as error:
        raise SubstitutionFailure(f"The file '{path}' is not valid YAML: {error}") from error
    if data is not None and not isinstance(data, dict):
        raise SubstitutionFailure(
            f"The file '{path}' must map the names of nodes to parameters, but is {data!r:.40}."
        )
    return data or {}


def _with_values(data: Any, values: Mapping[str, Any], path: str = '') -> Any:
    """Replace the values of names, and of ends of paths, in the data."""
    if not isinstance(data, dict):
        return data
    changed = {}
    for key, value in data.items():
        full = f'{path}.{key}' if path else str(key)
        found = next((name for name in (full, str(key)) if name in values), None)
        if found is None or isinstance(value, dict):
            changed[key] = _with_values(value, values, full)
        else:
            changed[key] = values[found]
    return changed


def _add(data: Any, keys: list[str], value: Any) -> None:
    """Set the value at a path, creating missing keys."""
    for key in keys[:-1]:
        data = data.setdefault(key, {})
        if not isinstance(data, dict):
            return
    data[keys[-1]] = value


def _with_keys(data: Any, keys: Mapping[str, str]) -> Any:
    if not isinstance(data, dict):
        return data
    return {keys.get(str(key), key): _with_keys(value, keys) for key, value in data.items()}


def _with_new_values(data: Any, values: Mapping[str, Any]) -> Any:
    if isinstance(data, dict):
        return {key: _with_new_values(value, values) for key, value in data.items()}
    if isinstance(data, list):
        return [_with_new_values(value, values) for value in data]
    return values.get(data, data) if isinstance(data, str) else data
