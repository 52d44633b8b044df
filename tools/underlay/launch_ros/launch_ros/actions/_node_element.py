# SPDX-License-Identifier: Apache-2.0
"""How the element `node` of a launch file in XML or YAML becomes a Node."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Optional, TYPE_CHECKING

from launch.actions.execute_process import ExecuteProcess

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser

# Launch file attributes and the constructor arguments that they set.
_TEXT_ATTRIBUTES = {
    'pkg': 'package',
    'name': 'name',
    'namespace': 'namespace',
    'exec_name': 'exec_name',
}
_COMMAND_ATTRIBUTES = {'args': 'arguments', 'ros_args': 'ros_arguments'}


class NodeElement(ExecuteProcess):
    """Action read from an element `node`: its process, its names and its parameters."""

    @classmethod
    def parse(
        cls,
        entity: Entity,
        parser: Parser,
        ignore: Optional[Iterable[str]] = None,
    ) -> tuple[Any, dict[str, Any]]:
        """
        Parse an element of a launch file into the class and its keyword arguments.

        Parameters
        ----------
        entity
            The `node` element, with children `param`, `remap` and `env`.
        parser
            Parses substitutions in its attributes.
        ignore
            Names of process attributes that a subclass parses itself.

        Returns
        -------
        tuple
            The class and the keyword arguments of its constructor.

        """
        from launch.frontend.attributes import parse_command, parse_texts
        from launch_ros.utilities.parse_parameters import parse_parameters, parse_remappings

        _, kwargs = super().parse(entity, parser, ignore=['cmd', 'name', *(ignore or ())])
        kwargs['executable'] = parser.parse_substitution(entity.get_attr('exec'))
        kwargs.update(parse_texts(entity, parser, _TEXT_ATTRIBUTES))
        for attribute, keyword in _COMMAND_ATTRIBUTES.items():
            line = entity.get_attr(attribute, optional=True)
            if line is not None:
                kwargs[keyword] = parse_command(line, parser)
        kwargs.update(parse_parameters(entity, parser))
        kwargs.update(parse_remappings(entity, parser))
        return cls, kwargs

    @staticmethod
    def parse_nested_parameters(params: list[Entity], parser: Parser) -> list[Any]:
        """
        Parse `param` elements into dictionaries and parameter files.

        Parameters
        ----------
        params
            The elements.
        parser
            Parses substitutions in their attributes.

        Returns
        -------
        list
            A dictionary for each element with a name, a ParameterFile for each with `from`.

        Raises
        ------
        ValueError
            An element has neither a value nor nested elements, or both, or an unknown attribute.

        """
        from launch_ros.utilities.parse_parameters import parse_nested_parameters

        return parse_nested_parameters(params, parser)
