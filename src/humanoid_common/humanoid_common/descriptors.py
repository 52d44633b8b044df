# SPDX-License-Identifier: Apache-2.0
"""Describe parameters to ROS, so that `ros2 param describe` shows meaning and limits."""

from __future__ import annotations

import sys

from humanoid_common.parameters import ParameterSpec
from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor

_LARGEST_INTEGER = 2**63 - 1


def descriptor_of(spec: ParameterSpec) -> ParameterDescriptor:
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
