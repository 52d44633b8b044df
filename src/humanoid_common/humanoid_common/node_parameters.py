# SPDX-License-Identifier: Apache-2.0
"""The parameters of a node, as an immutable snapshot that follows every accepted change."""

from __future__ import annotations

from collections.abc import Callable
import sys
from typing import Any, Generic, TypeVar

from humanoid_common.parameters import (
    build,
    ParameterError,
    ParameterSpec,
    specs_of,
    unknown_parameter_warnings,
    values_of,
    widened,
)
from rcl_interfaces.msg import (
    FloatingPointRange,
    IntegerRange,
    ParameterDescriptor,
    SetParametersResult,
)
from rclpy.node import Node
from rclpy.parameter import Parameter

T = TypeVar('T')
_WIDER = {
    Parameter.Type.INTEGER: Parameter.Type.DOUBLE,
    Parameter.Type.INTEGER_ARRAY: Parameter.Type.DOUBLE_ARRAY,
}
_LARGEST_INTEGER = 2**63 - 1


class NodeParameters(Generic[T]):
    """
    Parameters of a node, declared from a dataclass, with their current snapshot.

    A change at run time is checked as a whole and rejected with its reason; an accepted one
    replaces the snapshot and is passed to `on_change`.

    Parameters
    ----------
    node
        The node, whose parameter files and `-p` arguments set the initial values.
    kind
        The dataclass, whose fields are declared with `parameter`.
    on_change
        Called with the new snapshot after an accepted change.

    Raises
    ------
    ParameterError
        An initial value is invalid; the message names the node.

    """

    def __init__(
        self,
        node: Node,
        kind: type[T],
        on_change: Callable[[T], None] | None = None,
    ) -> None:
        self._node = node
        self._kind = kind
        self._specs = specs_of(kind)
        self._on_change = on_change
        self._current = self._declare()
        node.add_pre_set_parameters_callback(self._widen)
        node.add_on_set_parameters_callback(self._check)
        node.add_post_set_parameters_callback(self._swap)

    @property
    def current(self) -> T:
        """Return the snapshot of all parameters."""
        return self._current

    def _declare(self) -> T:
        """Check the initial values, declare all parameters, and warn of unknown ones."""
        given = _given_values(self._node)
        known = {name: value for name, value in given.items() if name in self._specs}
        snapshot = self._build_at_start(known)
        for name, value in values_of(snapshot).items():
            self._node.declare_parameter(
                name, value, _descriptor_of(self._specs[name]), ignore_override=True
            )
        self._warn_of_unknown(given)
        return snapshot

    def _build_at_start(self, values: dict[str, Any]) -> T:
        """Build the initial snapshot; an error names the node."""
        try:
            return build(self._kind, values)
        except ParameterError as error:
            raise ParameterError(
                f"Node '{self._node.get_fully_qualified_name()}' cannot start. {error.reason} "
                "Correct the parameter file or the '-p' argument that sets it.",
                *error.names,
            ) from error

    def _warn_of_unknown(self, given: dict[str, Any]) -> None:
        """Log a warning for each given value of an unknown parameter."""
        others = [
            name
            for name in given
            if not self._node.has_parameter(name) and not name.startswith('qos_overrides.')
        ]
        for warning in unknown_parameter_warnings(others, self._specs):
            self._node.get_logger().warning(warning)

    def _widen(self, changes: list[Parameter]) -> list[Parameter]:
        """Convert integers where a floating-point number is expected."""
        return [self._widen_one(change) for change in changes]

    def _widen_one(self, change: Parameter) -> Parameter:
        """Convert an integer if the parameter is a floating-point number."""
        spec = self._specs.get(change.name)
        wide_type = _WIDER.get(change.type_)
        if spec is None or spec.element is not float or wide_type is None:
            return change
        return Parameter(change.name, wide_type, widened(spec, change.value))

    def _check(self, changes: list[Parameter]) -> SetParametersResult:
        """Accept the changes only when the snapshot that they lead to is valid."""
        try:
            self._changed(changes)
        except ParameterError as error:
            return SetParametersResult(successful=False, reason=error.reason)
        return SetParametersResult(successful=True)

    def _swap(self, changes: list[Parameter]) -> None:
        """Replace the snapshot after an accepted change, and notify the node."""
        snapshot = self._changed(changes)
        if snapshot != self._current:
            self._current = snapshot
            if self._on_change is not None:
                self._on_change(snapshot)

    def _changed(self, changes: list[Parameter]) -> T:
        """Build the snapshot that the changes lead to."""
        new = {change.name: change.value for change in changes if change.name in self._specs}
        return build(self._kind, {**values_of(self._current), **new})


def _given_values(node: Node) -> dict[str, Any]:
    """
    Return the values that parameter files and `-p` arguments set for this node.

    rclpy offers no public way to ask for values of parameters that are not declared.
    """
    overrides: dict[str, Parameter] = getattr(node, '_parameter_overrides', {})
    return {name: override.value for name, override in overrides.items()}


def _descriptor_of(spec: ParameterSpec) -> ParameterDescriptor:
    """
    Convert the rules of a parameter to its ROS parameter descriptor.

    Parameters
    ----------
    spec
        The parameter: its description, limits and choices, and whether it is read-only.

    """
    descriptor = ParameterDescriptor(
        name=spec.name, description=spec.rules.description, read_only=spec.rules.read_only
    )
    if spec.rules.choices:
        descriptor.additional_constraints = 'One of: ' + ', '.join(spec.rules.choices)
    if spec.rules.at_least is not None or spec.rules.at_most is not None:
        _add_range(descriptor, spec)
    return descriptor


def _add_range(descriptor: ParameterDescriptor, spec: ParameterSpec) -> None:
    """Add the limits; those of a list are put in words, as ROS has no range for lists."""
    low, high = spec.rules.at_least, spec.rules.at_most
    if spec.is_list:
        between = f'between {low} and {high}'
        bounds = f'at most {high}' if low is None else f'at least {low}'
        told = bounds if None in (low, high) else between
        descriptor.additional_constraints = f'Each element {told}'
    elif spec.element is float:
        descriptor.floating_point_range = [
            FloatingPointRange(
                from_value=-sys.float_info.max if low is None else float(low),
                to_value=sys.float_info.max if high is None else float(high),
            )
        ]
    else:
        descriptor.integer_range = [
            IntegerRange(
                from_value=-_LARGEST_INTEGER if low is None else int(low),
                to_value=_LARGEST_INTEGER if high is None else int(high),
            )
        ]
