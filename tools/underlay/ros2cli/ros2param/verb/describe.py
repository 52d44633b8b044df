# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 param describe`."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
import sys

from rcl_interfaces.msg import ParameterDescriptor
from ros2param.api import (
    add_node_name_argument,
    add_param_arguments,
    describe_parameters,
    list_parameters,
    remote_node,
    unknown_parameter_text,
)
from ros2param.verb import VerbExtension


class DescribeVerb(VerbExtension):
    """Show descriptive information about declared parameters."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the names of the node and the parameters.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The command line up to the verb, such as `ros2 param describe`; unused.

        """
        add_param_arguments(parser)
        add_node_name_argument(parser)
        parser.add_argument('parameter_names', nargs='+', help='Names of the parameters')

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the descriptor of each parameter; unknown ones are reported on stderr.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments.

        """
        with remote_node(args) as (node, name):
            known = set(list_parameters(node, name))
            wanted = [each for each in args.parameter_names if each in known]
            descriptors = describe_parameters(node, name, wanted) if wanted else []
        for descriptor in descriptors:
            print('\n'.join(_description_lines(descriptor)))
        for each in args.parameter_names:
            if each not in known:
                print(unknown_parameter_text(name, each, known), file=sys.stderr)
        return None


def _description_lines(descriptor: ParameterDescriptor) -> Iterator[str]:
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
    from ros2param.api.values import type_name

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
