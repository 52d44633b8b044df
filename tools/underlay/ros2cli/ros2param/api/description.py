# SPDX-License-Identifier: Apache-2.0
"""Formatting of parameter descriptors."""

from __future__ import annotations

from collections.abc import Iterator

from rcl_interfaces.msg import ParameterDescriptor
from ros2param.api.values import type_name


def description_lines(descriptor: ParameterDescriptor) -> Iterator[str]:
    """
    Format a parameter descriptor as lines: name, type, description and constraints.

    Parameters
    ----------
    descriptor
        The descriptor that the node returns.

    Yields
    ------
    str
        One line, without the line break.

    """
    yield f'Parameter name: {descriptor.name}'
    yield f'  Type: {type_name(descriptor.type)}'
    if descriptor.description:
        yield f'  Description: {descriptor.description}'
    yield '  Constraints:'
    if descriptor.read_only:
        yield '    Read only: true'
    for limits in (*descriptor.integer_range, *descriptor.floating_point_range):
        yield f'    Min value: {limits.from_value}'
        yield f'    Max value: {limits.to_value}'
        if limits.step:
            yield f'    Step: {limits.step}'
    if descriptor.additional_constraints:
        yield f'    Additional constraints: {descriptor.additional_constraints}'
