# SPDX-License-Identifier: Apache-2.0
"""Check values and names against the rules of the parameters, and build a snapshot of all."""

from __future__ import annotations

from array import array
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import fields, is_dataclass
import math
from typing import Any, cast, TypeVar, Union

from humanoid_common.errors import UserError
from humanoid_common.naming import did_you_mean
from humanoid_common.parameters.specs import ParameterSpec, specs_of

Scalar = Union[bool, int, float, str]
ParameterValue = Union[Scalar, tuple[Scalar, ...]]
T = TypeVar('T')


class ParameterError(UserError):
    """
    The values of one or several parameters are invalid.

    Raise it in `__post_init__` of a parameter dataclass to reject inconsistent values. `reason` is
    the message, a full sentence, and `names` are the parameters concerned.
    """

    def __init__(self, reason: str, *names: str) -> None:
        super().__init__(reason)
        self.reason = reason
        self.names = names

    def within(self, group: str) -> ParameterError:
        """
        Return the same error with the full names of the parameters of a group.

        Parameters
        ----------
        group
            The name of the group, which its own check does not know.

        """
        reason = self.reason
        for name in self.names:
            reason = reason.replace(f"'{name}'", f"'{group}.{name}'")
        return ParameterError(reason, *(f'{group}.{name}' for name in self.names))


def widened(spec: ParameterSpec, value: Any) -> Any:
    """
    Convert integers to floats where a parameter is a floating-point number, or a list of them.

    Parameters
    ----------
    spec
        The parameter.
    value
        The value as it was given, of any type; all but integers stay as they are.

    """
    if spec.element is not float:
        return value
    if spec.is_list and _is_sequence(value):
        return [_as_float(element) for element in value]
    return _as_float(value)


def checked_value(spec: ParameterSpec, value: Any) -> ParameterValue:
    """
    Validate a value against the type, limits and choices of its parameter.

    Parameters
    ----------
    spec
        The parameter.
    value
        The value as it was given, of any type.

    Returns
    -------
    ParameterValue
        The value in the type of the parameter; a list becomes a tuple.

    Raises
    ------
    ParameterError
        The value violates a rule, or is an empty list; the message states which, and what it must
        be.

    """
    value = widened(spec, value)
    if spec.is_list:
        if not _is_sequence(value):
            raise _refusal(spec, value, f'must be {spec.expected}', verb='is')
        if len(value) == 0:
            raise _refusal(spec, value, 'must not be empty', verb='is')
        return tuple(_checked_element(spec, element) for element in value)
    return _checked_element(spec, value)


def _checked_element(spec: ParameterSpec, value: Any) -> Scalar:
    """Check the type, the limits and the choices of one element."""
    if type(value) is not spec.element:
        raise _refusal(spec, value, f'must be {spec.expected}')
    if isinstance(value, float) and not math.isfinite(value):
        raise _refusal(spec, value, 'must be finite')
    if isinstance(value, (int, float)):
        _check_limits(spec, value)
    if isinstance(value, str) and spec.rules.choices and value not in spec.rules.choices:
        allowed = ', '.join(repr(choice) for choice in spec.rules.choices)
        hint = did_you_mean(value, spec.rules.choices)
        raise _refusal(spec, value, f'must be one of {allowed}', hint)
    return cast(Scalar, value)


def _check_limits(spec: ParameterSpec, value: float) -> None:
    """Check that a number lies within the limits."""
    low, high = spec.rules.at_least, spec.rules.at_most
    if (low is None or value >= low) and (high is None or value <= high):
        return
    if low is None:
        raise _refusal(spec, value, f'must be at most {high}')
    if high is None:
        raise _refusal(spec, value, f'must be at least {low}')
    raise _refusal(spec, value, f'must be between {low} and {high}')


def _refusal(
    spec: ParameterSpec,
    value: Any,
    requirement: str,
    hint: str = '',
    verb: str = '',
) -> ParameterError:
    """Build the error about an invalid value, which for a list is one of its elements."""
    verb = verb or ('contains' if spec.is_list else 'is')
    sentences = [
        f"Parameter '{spec.name}' {verb} {value!r}, but {requirement}.",
        hint,
        f'Description: {spec.rules.description}',
    ]
    return ParameterError(' '.join(filter(None, sentences)), spec.name)


def _is_sequence(value: Any) -> bool:
    """Check whether the value is a sequence of elements, which a string is not."""
    return isinstance(value, (Sequence, array)) and not isinstance(value, (str, bytes))


def _as_float(value: Any) -> Any:
    """Convert an integer to a float; return all else unchanged."""
    return float(value) if type(value) is int else value


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


def unknown_parameter_warnings(given: Iterable[str], known: Iterable[str]) -> list[str]:
    """
    Build a warning for each parameter that was set but does not exist.

    Parameters
    ----------
    given
        Names of the parameters that were set.
    known
        Names of the parameters of the node.

    Returns
    -------
    list of str
        One message per name, in alphabetical order.

    """
    names = sorted(known)
    return [_warning(name, names) for name in sorted(set(given) - set(names))]


def _warning(name: str, known: list[str]) -> str:
    """Build the warning for one unknown name."""
    groups = sorted({each.partition('.')[0] + '.*' if '.' in each else each for each in known})
    advice = did_you_mean(name, known) or f'It has: {", ".join(groups)}.'
    return f"Ignored the value of '{name}': this node has no such parameter. {advice}"
