# SPDX-License-Identifier: Apache-2.0
"""Build a checked snapshot of all parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from typing import Any, TypeVar

from humanoid_common.parameters.errors import ParameterError
from humanoid_common.parameters.specs import specs_of
from humanoid_common.parameters.values import checked_value

T = TypeVar('T')


def build(kind: type[T], values: Mapping[str, Any]) -> T:
    """
    Build a parameter dataclass from values; those that are missing take their defaults.

    Each value is checked by the rules of its field; then the dataclass itself checks, in its
    `__post_init__`, what must hold for all of them together.

    Parameters
    ----------
    kind
        The dataclass, as `specs_of` reads it.
    values
        Values by parameter name; names in a group contain a dot.

    Raises
    ------
    ParameterError
        A value violates the rules of its parameter, or the values are inconsistent.

    """
    specs = specs_of(kind)
    checked = {name: checked_value(specs[name], value) for name, value in values.items()}
    built: T = _assembled(kind, checked)
    return built


def values_of(snapshot: Any) -> dict[str, Any]:
    """
    List the values of all parameters, also those of groups.

    Parameters
    ----------
    snapshot
        A parameter dataclass.

    Returns
    -------
    dict
        The values by parameter name, as `build` accepts them.

    """
    found = {}
    for declared in fields(snapshot):
        value = getattr(snapshot, declared.name)
        if is_dataclass(value):
            found.update({f'{declared.name}.{k}': v for k, v in values_of(value).items()})
        else:
            found[declared.name] = value
    return found


def _assembled(kind: Any, values: Mapping[str, Any]) -> Any:
    """Build a dataclass from values and groups of values."""
    own: dict[str, Any] = {}
    groups: dict[str, dict[str, Any]] = {}
    for name, value in values.items():
        first, is_inside, rest = name.partition('.')
        if is_inside:
            groups.setdefault(first, {})[rest] = value
        else:
            own[name] = value
    for declared in fields(kind):
        if declared.name in groups:
            try:
                own[declared.name] = _assembled(type(declared.default), groups[declared.name])
            except ParameterError as error:
                raise error.within(declared.name) from None
    return kind(**own)
