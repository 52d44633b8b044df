# SPDX-License-Identifier: Apache-2.0
"""Declaration of the parameters of a dataclass, and their specifications."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, Field, field, fields, is_dataclass, replace
from typing import Any, get_args, get_origin, get_type_hints, TypeVar

T = TypeVar('T')
_RULES = 'humanoid_common.parameters'
_SCALARS = {
    bool: ('true or false', 'true and false values'),
    int: ('an integer', 'integers'),
    float: ('a number', 'numbers'),
    str: ('a string', 'strings'),
}


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


@dataclass(frozen=True)
class ParameterSpec:
    """One parameter: its name, its type, its default and its rules."""

    name: str
    element: type
    is_list: bool
    default: Any
    rules: ParameterRules

    @property
    def expected(self) -> str:
        """Return the type in words, for messages."""
        one, many = _SCALARS[self.element]
        return f'a list of {many}' if self.is_list else one


_READ: dict[type, dict[str, ParameterSpec]] = {}


def specs_of(kind: type) -> dict[str, ParameterSpec]:
    """
    Read the parameters that a dataclass declares; the result is cached, so leave it as it is.

    Parameters
    ----------
    kind
        The dataclass, whose fields are declared with `parameter`, or are such dataclasses
        themselves: groups, whose name and a dot prefix the names of their parameters.

    Returns
    -------
    dict
        The specification of each parameter, by name and in the order of the fields.

    Raises
    ------
    TypeError
        A field is not declared with `parameter`, or its type is not that of a ROS parameter.

    """
    if kind not in _READ:
        _READ[kind] = _read(kind)
    return _READ[kind]


def _read(kind: type) -> dict[str, ParameterSpec]:
    """Read the type and the rules of each field."""
    hints = get_type_hints(kind)
    specs = {}
    for declared in fields(kind):
        if is_dataclass(hints[declared.name]):
            for name, spec in specs_of(hints[declared.name]).items():
                full = f'{declared.name}.{name}'
                specs[full] = replace(spec, name=full)
            continue
        element, is_list = _element_of(declared.name, hints[declared.name])
        specs[declared.name] = ParameterSpec(
            declared.name, element, is_list, declared.default, rules_of(declared)
        )
    return specs


def _element_of(name: str, hint: Any) -> tuple[type, bool]:
    """Split a type hint into the type of one element and whether it is a list."""
    if hint in _SCALARS:
        return hint, False
    arguments = get_args(hint)
    is_tuple = get_origin(hint) is tuple and len(arguments) == 2 and arguments[1] is Ellipsis
    if is_tuple and arguments[0] in _SCALARS:
        return arguments[0], True
    raise TypeError(
        f"Parameter '{name}' has type {hint}, but must have one of bool, int, float, str, "
        'or a tuple of them such as tuple[float, ...].'
    )
