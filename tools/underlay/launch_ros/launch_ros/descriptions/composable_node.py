# SPDX-License-Identifier: Apache-2.0
"""Descriptions of composable nodes."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Optional, TYPE_CHECKING

from launch.substitution import SomeSubstitutionsType, Substitution
from launch.utilities import normalize_to_list_of_substitutions
from launch_ros.utilities.parameters_and_remappings import (
    normalize_parameters,
    normalize_remap_rules,
    NormalizedParameters,
    RemapRule,
)

if TYPE_CHECKING:
    from launch.conditions import Condition
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser

_TAG = 'composable_node'

# Launch file attributes and the constructor arguments that they set.
_TEXT_ATTRIBUTES = {
    'pkg': 'package',
    'plugin': 'plugin',
    'name': 'name',
    'namespace': 'namespace',
}


class ComposableNode:
    """
    The description of a node that is loaded into a component container, as a plugin.

    Parameters
    ----------
    package
        The package that provides the plugin.
    plugin
        The class name of the node, such as `composition::Talker`.
    name
        The node name; by default that of the class.
    namespace
        The namespace, relative to that of PushROSNamespace unless it is absolute.
    parameters : Optional[list[Any]]
        Dictionaries, paths of parameter files, ParameterFile and Parameter; later ones override.
    remappings
        Tuples of the original and the new name.
    extra_arguments
        Arguments for the container, in the same form as parameters.
    condition
        The node is loaded if this is None or evaluates to true.

    Raises
    ------
    TypeError
        Parameters or remappings do not have the required form.

    """

    def __init__(
        self,
        *,
        package: SomeSubstitutionsType,
        plugin: SomeSubstitutionsType,
        name: Optional[SomeSubstitutionsType] = None,
        namespace: Optional[SomeSubstitutionsType] = None,
        parameters: Optional[list[Any]] = None,
        remappings: Optional[Iterable[Any]] = None,
        extra_arguments: Optional[list[Any]] = None,
        condition: Optional[Condition] = None,
    ) -> None:
        self.__package = normalize_to_list_of_substitutions(package)
        self.__node_plugin = normalize_to_list_of_substitutions(plugin)
        self.__node_name = _optional(name)
        self.__node_namespace = _optional(namespace)
        self.__parameters = normalize_parameters(parameters or [])
        self.__remappings = normalize_remap_rules(remappings or [])
        self.__extra_arguments = normalize_parameters(extra_arguments or [])
        self.__condition = condition

    @classmethod
    def parse(cls, parser: Parser, entity: Entity) -> tuple[Any, dict[str, Any]]:
        """
        Parse an element of a launch file into the class and its keyword arguments.

        Parameters
        ----------
        parser
            Parses substitutions in its attributes.
        entity
            The `composable_node` element, with children `param`, `remap` and `extra_arg`.

        Returns
        -------
        tuple
            The class and the keyword arguments of its constructor.

        Raises
        ------
        AttributeError
            The attribute `pkg`, `plugin` or `name` is missing.
        ValueError
            The element has unknown attributes or children.

        """
        from launch.action import Action
        from launch.frontend.attributes import children_named, parse_texts
        from launch_ros.utilities.parse_parameters import (
            parse_nested_parameters,
            parse_parameters,
            parse_remappings,
        )

        for name in ('pkg', 'plugin', 'name'):
            entity.get_attr(name)
        _, kwargs = Action.parse(entity, parser)
        kwargs.update(parse_texts(entity, parser, _TEXT_ATTRIBUTES))
        kwargs.update(parse_parameters(entity, parser))
        kwargs.update(parse_remappings(entity, parser))
        extra = children_named(entity, 'extra_arg')
        kwargs['extra_arguments'] = parse_nested_parameters(extra, parser)
        entity.assert_entity_completely_parsed()
        return cls, kwargs

    @property
    def package(self) -> list[Substitution]:
        """Return the package name, as substitutions."""
        return self.__package

    @property
    def node_plugin(self) -> list[Substitution]:
        """Return the class name of the node, as substitutions."""
        return self.__node_plugin

    @property
    def node_name(self) -> Optional[list[Substitution]]:
        """Return the node name, as substitutions; None if not given."""
        return self.__node_name

    @property
    def node_namespace(self) -> Optional[list[Substitution]]:
        """Return the namespace, as substitutions; None if not given."""
        return self.__node_namespace

    @property
    def parameters(self) -> list[NormalizedParameters]:
        """Return the parameters."""
        return self.__parameters

    @property
    def remappings(self) -> list[RemapRule]:
        """Return the remappings."""
        return self.__remappings

    @property
    def extra_arguments(self) -> list[NormalizedParameters]:
        """Return the arguments for the container."""
        return self.__extra_arguments

    def condition(self) -> Optional[Condition]:
        """Return the condition; None if the node is always loaded."""
        return self.__condition


def parse_composable_nodes(entity: Entity, parser: Parser) -> list[ComposableNode]:
    """
    Parse the `composable_node` children of an element, if any.

    Parameters
    ----------
    entity
        The parent element.
    parser
        Parses substitutions in their attributes.

    """
    from launch.frontend.attributes import children_named

    parsed = [ComposableNode.parse(parser, child) for child in children_named(entity, _TAG)]
    return [node_class(**kwargs) for node_class, kwargs in parsed]


def _optional(text: Optional[SomeSubstitutionsType]) -> Optional[list[Substitution]]:
    return None if text is None else normalize_to_list_of_substitutions(text)
