# SPDX-License-Identifier: Apache-2.0
"""Parameters as data: a frozen dataclass declares, describes and limits them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import field, fields, MISSING, replace
from typing import Any, Generic, TYPE_CHECKING, TypeVar

from nav2_util.errors import ConfigurationError
from nav2_util.parameter_values import (
    check_limits,
    coerced,
    make_descriptor,
    Spec,
    typed_parameter,
    Unsupported,
)
from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult
from rclpy.exceptions import InvalidParameterTypeException
from rclpy.parameter import Parameter
from ros_environment.suggestions import did_you_mean

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['ParameterServer', 'ParameterSet', 'Unsupported', 'parameter']

ParametersT = TypeVar('ParametersT')
_QOS_OVERRIDES = '.allow_parameter_qos_overrides'


def parameter(
    default: Any,
    description: str,
    *,
    low: float | None = None,
    high: float | None = None,
    choices: Sequence[Any] = (),
    name: str | None = None,
    read_only: bool = False,
) -> Any:
    """
    Make the field of a parameter dataclass.

    Parameters
    ----------
    default
        Its value if it is not set. Its type is that of the parameter: bool, int, float, str, or a
        list of one of them; an empty list is one of strings.
    description
        Its purpose, with the unit.
    low, high
        The limits of a number, both inclusive.
    choices
        All allowed values.
    name
        Its name if that is not a Python identifier; by default that of the field. It may contain
        dots.
    read_only
        Whether it can only be set when the node starts.

    """
    spec = Spec(description, low, high, tuple(choices), name, read_only)
    if isinstance(default, list):
        return field(default_factory=lambda: list(default), metadata={'spec': spec})
    return field(default=default, metadata={'spec': spec})


class ParameterSet(Generic[ParametersT]):
    """
    Parameters of a node as snapshots of a dataclass: `current` is replaced after each change.

    Objects keep the set and read `current` whenever needed, so that `ros2 param set` takes effect.

    Parameters
    ----------
    current
        The initial values.

    """

    def __init__(self, current: ParametersT) -> None:
        self.current = current
        self.on_change: Callable[[ParametersT], None] | None = None
        """
        Called with the new snapshot before it replaces `current`; may raise ValueError to reject
        it. If another set rejects the same change later, it is called with the old one again.
        """


class ParameterServer:
    """
    Parameter server of a node: declares parameters and updates their snapshots.

    A value of another type, or beyond its limits, raises a ConfigurationError when the node is
    configured, and is rejected with its message later.

    Parameters
    ----------
    node
        The node that has the parameters.

    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._sets: dict[str, list[tuple[ParameterSet[Any], str]]] = {}
        self._by_prefix: dict[tuple[str, type], ParameterSet[Any]] = {}
        self._complained: set[str] = set()
        self._unsupported: dict[str, Unsupported] = {}
        self._without_effect: dict[str, Unsupported] = {}
        """Those of `_unsupported` that are declared."""
        node.add_on_set_parameters_callback(self._check)

    def declare(self, kind: type[ParametersT], prefix: str = '') -> ParameterSet[ParametersT]:
        """
        Declare all parameters of a dataclass, or return the existing set.

        Parameters
        ----------
        kind
            A frozen dataclass with fields made by `parameter`.
        prefix
            The prefix of their names without the dot, such as the name of a plugin.

        Raises
        ------
        ConfigurationError
            An initial value has another type or is not allowed.

        """
        known = self._by_prefix.get((prefix, kind))
        if known is not None:
            return known
        values: dict[str, Any] = {}
        names: dict[str, str] = {}
        for each in fields(kind):  # type: ignore[arg-type]
            spec: Spec = each.metadata['spec']
            full = _full(prefix, spec.name or each.name)
            default = getattr(kind, each.name, None)
            if default is None and each.default_factory is not MISSING:
                default = each.default_factory()
            values[each.name] = self._declare_one(full, default, spec)
            names[full] = each.name
        found = ParameterSet(kind(**values))
        self._by_prefix[prefix, kind] = found
        for full, name in names.items():
            self._sets.setdefault(full, []).append((found, name))
        return found

    def declare_value(self, name: str, default: Any, description: str) -> Any:
        """
        Declare a single parameter whose name is only known at run time.

        Parameters
        ----------
        name
            The full name, with its prefix.
        default
            Its value if it is not set, of the type of the parameter.
        description
            Its purpose, with the unit.

        Returns
        -------
        Any
            Its value, even if it was declared before.

        Raises
        ------
        ConfigurationError
            The initial value has another type.

        """
        if self._node.has_parameter(name):
            return self._node.get_parameter(name).value
        return self._declare_one(name, default, Spec(description, None, None, (), None, False))

    def declare_unsupported(
        self, names: Mapping[str, str | Unsupported], prefix: str = ''
    ) -> None:
        """
        Name parameters of Nav2 that are not supported.

        `report` warns about those that are given and declares them, so that they can be read and
        set as in Nav2; without a value, only those with a usual value are declared.

        Parameters
        ----------
        names
            The names of parameters and what happens instead, as the end of a sentence, or with
            the values that need no warning.
        prefix
            The prefix of the names, without the dot.

        """
        for name, instead in names.items():
            if isinstance(instead, str):
                instead = Unsupported(instead, ())
            self._unsupported[_full(prefix, name)] = instead

    @property
    def given(self) -> dict[str, Parameter]:
        """The values with which the node was started, by the full names of parameters."""
        given: dict[str, Parameter] = self._node._parameter_overrides  # rclpy has no public name
        return given

    def take_given(self, prefix: str) -> dict[str, Parameter]:
        """
        Remove given values that are meant for another node, and return them.

        Parameters
        ----------
        prefix
            What their names begin with, with the dot.

        Returns
        -------
        dict of str to Parameter
            The values by the rest of their names.

        """
        given = self.given
        names = [name for name in given if name.startswith(prefix)]
        return {name.removeprefix(prefix): given.pop(name) for name in names}

    def report(self) -> None:
        """Log given parameters without effect, suggest similar names, and declare the others."""
        unknown = [
            name
            for name in self.given
            if not self._node.has_parameter(name) and name not in self._complained
        ]
        self._complained.update(unknown)
        log = self._node.get_logger()
        without_effect: dict[str, list[str]] = {}
        for name in sorted(unknown):
            unsupported = self._unsupported.get(name)
            if unsupported is None:
                if not name.startswith('qos_overrides.') and not name.endswith(_QOS_OVERRIDES):
                    log.warning(f"There is no parameter '{name}'. {self._advice(name)}")
            elif unsupported.needs_warning(self.given[name].value):
                without_effect.setdefault(unsupported.instead, []).append(f"'{name}'")
        for instead, names in without_effect.items():
            which = (
                f'The parameter {names[0]} has'
                if len(names) == 1
                else f'The parameters {", ".join(names)} have'
            )
            log.warning(f'{which} no effect: {instead}.')
        self._declare_without_effect()

    def _declare_without_effect(self) -> None:
        for name, unsupported in self._unsupported.items():
            if self._node.has_parameter(name) or not (unsupported.usual or name in self.given):
                continue
            default = unsupported.usual[0] if unsupported.usual else self.given[name].value
            description = f'Without effect: {unsupported.instead}.'
            self._node.declare_parameter(
                name, default, ParameterDescriptor(description=description, dynamic_typing=True)
            )
            self._without_effect[name] = unsupported

    def _advice(self, name: str) -> str:
        known = [*self._node.list_parameters([], 0).names, *self._unsupported]
        return did_you_mean(name, known, 0.75, ignore_case=True) or 'It has no effect.'

    def _declare_one(self, name: str, default: Any, spec: Spec) -> Any:
        if self._node.has_parameter(name):
            return self._node.get_parameter(name).value
        given = self.given.get(name)
        if given is not None and given.value is not None:
            try:
                value = coerced(given.value, default)
                check_limits(value, spec)
            except ValueError as error:
                raise ConfigurationError(f"The parameter '{name}' {error}.") from error
            # rclpy does not accept integers for floating-point numbers; parameter files mix them.
            self.given[name] = typed_parameter(name, value, default)
        descriptor = make_descriptor(name, default, spec)
        try:
            declared = self._node.declare_parameter(name, default, descriptor)
        except InvalidParameterTypeException as error:
            raise ConfigurationError(str(error)) from error
        value = declared.value
        return default if value is None else coerced(value, default)

    def _check(self, parameters: Sequence[Parameter]) -> SetParametersResult:
        """Reject invalid values; replace the snapshots of the others."""
        for each in parameters:
            unsupported = self._without_effect.get(each.name)
            if unsupported is not None and unsupported.needs_warning(each.value):
                self._node.get_logger().warning(
                    f'The parameter {each.name!r} has no effect: {unsupported.instead}.'
                )
        changed: dict[int, tuple[ParameterSet[Any], dict[str, Any]]] = {}
        for each in parameters:
            for found, name in self._sets.get(each.name, ()):
                try:
                    value = coerced(each.value, getattr(found.current, name))
                    check_limits(value, _spec_of(found.current, name))
                except ValueError as error:
                    return _refused(f"The parameter '{each.name}' {error}.")
                changed.setdefault(id(found), (found, {}))[1][name] = value
        new = [(found, replace(found.current, **values)) for found, values in changed.values()]
        replaced: list[tuple[ParameterSet[Any], Any]] = []
        for found, snapshot in new:
            before = found.current
            try:
                _put(found, snapshot)
            except ValueError as error:
                for earlier, old in reversed(replaced):
                    _put(earlier, old)
                return _refused(str(error))
            replaced.append((found, before))
        return SetParametersResult(successful=True)


def _put(found: ParameterSet[ParametersT], snapshot: ParametersT) -> None:
    """Replace the snapshot of a set, unless its `on_change` raises ValueError."""
    if found.on_change is not None:
        found.on_change(snapshot)
    found.current = snapshot


def _full(prefix: str, name: str) -> str:
    return f'{prefix}.{name}' if prefix else name


def _spec_of(current: Any, name: str) -> Spec:
    spec: Spec = next(f for f in fields(current) if f.name == name).metadata['spec']
    return spec


def _refused(reason: str) -> SetParametersResult:
    return SetParametersResult(successful=False, reason=reason)
