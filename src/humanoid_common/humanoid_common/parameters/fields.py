# SPDX-License-Identifier: Apache-2.0
"""The fields of a parameter dataclass."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, Field, field
from typing import Any, TypeVar

T = TypeVar('T')
_RULES = 'humanoid_common.parameters'


@dataclass(frozen=True)
class ParameterRules:
    """Description of a parameter, and the values that it accepts."""

    description: str
    at_least: float | None = None
    at_most: float | None = None
    choices: tuple[str, ...] = ()
    read_only: bool = False


def parameter(
    default: T,
    description: str,
    *,
    at_least: float | None = None,
    at_most: float | None = None,
    choices: Sequence[str] = (),
    read_only: bool = False,
    metadata: Mapping[str, Any] = {},
) -> T:
    """
    Declare one parameter as a field of a frozen dataclass.

    Parameters
    ----------
    default, description
        Default value, of the type of the parameter, and description for `ros2 param describe`.
    at_least, at_most, choices
        Accepted values; for a list, those of each element.
    read_only
        Whether it cannot be changed while the node runs.
    metadata
        Further metadata of the field, as for `dataclasses.field`.

    """
    rules = ParameterRules(description, at_least, at_most, tuple(choices), read_only)
    return field(default=default, metadata={**metadata, _RULES: rules})


def rules_of(declared: Field[Any]) -> ParameterRules:
    """
    Look up the rules that `parameter` stored in a dataclass field.

    Parameters
    ----------
    declared
        A field of a parameter dataclass.

    Raises
    ------
    TypeError
        The field is not declared with `parameter`.

    """
    rules = declared.metadata.get(_RULES)
    if not isinstance(rules, ParameterRules):
        raise TypeError(f"Field '{declared.name}' is not declared with parameter(...).")
    return rules
