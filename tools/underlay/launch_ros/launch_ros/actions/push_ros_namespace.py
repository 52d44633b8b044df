# SPDX-License-Identifier: Apache-2.0
"""Launch action that pushes a namespace for the nodes that follow."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING

from launch.action import Action
from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType, Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.utilities.namespace_utils import make_namespace_absolute, prefix_namespace

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser


class PushROSNamespace(Action):
    """
    Puts the nodes that follow below a namespace, to the end of the group that it is in.

    Parameters
    ----------
    namespace
        A relative namespace is appended to the current one; an absolute one replaces it.
    **kwargs
        As for `Action`: `condition`.

    """

    def __init__(self, namespace: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__namespace = normalize_to_list_of_substitutions(namespace)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """
        Parse an element of a launch file into the class and its keyword arguments.

        Parameters
        ----------
        entity
            The `push_ros_namespace` element, with the attribute `namespace`.
        parser
            Parses substitutions in its attributes.

        Returns
        -------
        tuple
            The class and the keyword arguments of its constructor.

        """
        _, kwargs = super().parse(entity, parser)
        kwargs['namespace'] = parser.parse_substitution(entity.get_attr('namespace'))
        return cls, kwargs

    @property
    def namespace(self) -> list[Substitution]:
        """Return the namespace, as substitutions."""
        return self.__namespace

    def execute(self, context: LaunchContext) -> None:
        """
        Combine the namespace with the current one.

        Parameters
        ----------
        context
            The launch context; its configuration `ros_namespace` holds the namespace.

        Raises
        ------
        RuntimeError
            The resulting namespace is not allowed in ROS.

        """
        from launch_ros.actions._node_names import InvalidNameError, validate_namespace

        pushed = perform_substitutions(context, self.__namespace)
        previous = context.launch_configurations.get('ros_namespace')
        namespace = make_namespace_absolute(prefix_namespace(previous, pushed)) or '/'
        try:
            validate_namespace(namespace)
        except InvalidNameError as error:
            raise RuntimeError(
                'The resulting namespace is invalid: '
                f"[previous_namespace='{previous}', pushed_namespace='{pushed}']. {error}",
            ) from error
        context.launch_configurations['ros_namespace'] = namespace
        context.run.note(namespace=namespace)


PushRosNamespace = PushROSNamespace
