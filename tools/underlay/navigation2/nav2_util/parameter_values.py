# SPDX-License-Identifier: Apache-2.0
"""Parameter values: their types, limits and conversion."""

from __future__ import annotations

from dataclasses import dataclass
import math
from typing import Any, NamedTuple

from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
from rclpy.parameter import Parameter
from ros_environment.suggestions import closest_name

__all__ = [
    'Spec',
    'Unsupported',
    'check_limits',
    'coerced',
    'make_descriptor',
    'typed_parameter',
]

_HUGE = 1e300


@dataclass(frozen=True)
class Spec:
    """Specification of a parameter besides its name, type and default."""

    description: str
    low: float | None
    high: float | None
    choices: tuple[Any, ...]
    name: str | None
    read_only: bool


class Unsupported(NamedTuple):
    """A parameter of Nav2 that has no effect."""

    instead: str
    """What happens instead, as the end of a sentence."""
    usual: tuple[Any, ...] | None = None
    """The values that need no warning, since they ask for that; None: no value needs one."""

    def needs_warning(self, value: Any) -> bool:
        """
        Whether a user who sets this value has to know that it has no effect.

        Parameters
        ----------
        value
            The given value.

        """
        return self.usual is not None and value not in self.usual


def typed_parameter(name: str, value: Any, like: Any) -> Parameter:
    """
    Make a parameter with the type of its default, even for an empty list.

    Parameters
    ----------
    name, value
        The name and value of the parameter.
    like
        The default; its first element has the type of the elements of an empty list.

    """
    if isinstance(value, list) and not value:
        first = like[0] if like else ''
        kinds = {
            bool: Parameter.Type.BOOL_ARRAY,
            int: Parameter.Type.INTEGER_ARRAY,
            float: Parameter.Type.DOUBLE_ARRAY,
        }
        return Parameter(name, kinds.get(type(first), Parameter.Type.STRING_ARRAY), [])
    return Parameter(name, value=value)


def coerced(value: Any, like: Any) -> Any:
    """
    Coerce a value to the type of another one: integers to floats, and whole floats to integers.

    Parameters
    ----------
    value
        The value to convert.
    like
        A value of the target type, such as the default.

    Returns
    -------
    Any
        The converted value; for a list, each element is converted.

    Raises
    ------
    ValueError
        It has another type; the text is the end of a sentence that starts with its name.

    """
    if isinstance(like, list):
        if isinstance(value, (str, bytes)) or not hasattr(value, '__iter__'):
            raise ValueError(f'must be a list, but is {value!r}')
        first = like[0] if like else None
        return [each if first is None else coerced(each, first) for each in value]
    if isinstance(like, bool) or isinstance(value, bool):
        if not (isinstance(like, bool) and isinstance(value, bool)):
            raise ValueError(f'must be {_kind(like)}, but is {value!r}')
        return value
    if isinstance(like, float) and isinstance(value, int):
        return float(value)
    if isinstance(like, int) and isinstance(value, float) and value.is_integer():
        return int(value)
    if type(value) is not type(like):
        raise ValueError(f'must be {_kind(like)}, but is {value!r}')
    return value


def _kind(value: Any) -> str:
    names = {bool: 'true or false', int: 'a whole number', float: 'a number', str: 'a text'}
    return names.get(type(value), type(value).__name__)


def check_limits(value: Any, spec: Spec) -> None:
    """
    Check a value against the limits and the choices of its parameter.

    Parameters
    ----------
    value
        The value; for a list, each element is checked.
    spec
        The specification of the parameter.

    Raises
    ------
    ValueError
        It is not allowed; the text is the end of a sentence that starts with its name.

    """
    for each in value if isinstance(value, list) else [value]:
        if isinstance(each, float) and math.isnan(each):
            raise ValueError('must be a number, but is nan')
        if spec.choices and each not in spec.choices:
            close = closest_name(str(each), map(str, spec.choices))
            meant = f"; did you mean '{close}'?" if close else ''
            allowed = ', '.join(f"'{choice}'" for choice in spec.choices)
            raise ValueError(f"must be one of {allowed}, but is '{each}'{meant}")
        if spec.low is not None and each < spec.low:
            raise ValueError(f'must be at least {spec.low:g}, but is {each:g}')
        if spec.high is not None and each > spec.high:
            raise ValueError(f'must be at most {spec.high:g}, but is {each:g}')


def make_descriptor(name: str, default: Any, spec: Spec) -> ParameterDescriptor:
    """
    Make the descriptor of a parameter, with its limits or choices.

    Parameters
    ----------
    name, default, spec
        The full name, the default and the specification of the parameter.

    """
    descriptor = ParameterDescriptor(
        name=name, description=spec.description, read_only=spec.read_only, dynamic_typing=True
    )
    if isinstance(default, float) and (spec.low is not None or spec.high is not None):
        low = -_HUGE if spec.low is None else spec.low
        high = _HUGE if spec.high is None else spec.high
        descriptor.floating_point_range = [FloatingPointRange(from_value=low, to_value=high)]
    elif isinstance(default, int) and spec.low is not None and spec.high is not None:
        descriptor.integer_range = [
            IntegerRange(from_value=int(spec.low), to_value=int(spec.high))
        ]
    if spec.choices:
        allowed = ', '.join(str(choice) for choice in spec.choices)
        descriptor.additional_constraints = f'One of {allowed}.'
    return descriptor
