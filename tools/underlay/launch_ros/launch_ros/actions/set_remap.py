# SPDX-License-Identifier: Apache-2.0
"""Launch action that adds a global remapping."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING

from launch.action import Action
from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType, Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser


class SetRemap(Action):
    """
    Remaps a name of the nodes that follow, to the end of the group that it is in.

    Parameters
    ----------
    src, dst
        The original and the new name.
    **kwargs
        As for `Action`: `condition`.

    """

    def __init__(
        self,
        src: SomeSubstitutionsType,
        dst: SomeSubstitutionsType,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.__src = normalize_to_list_of_substitutions(src)
        self.__dst = normalize_to_list_of_substitutions(dst)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """
        Parse an element of a launch file into the class and its keyword arguments.

        Parameters
        ----------
        entity
            The `set_remap` element, with the attributes `from` and `to`.
        parser
            Parses substitutions in its attributes.

        Returns
        -------
        tuple
            The class and the keyword arguments of its constructor.

        """
        _, kwargs = super().parse(entity, parser)
        kwargs['src'] = parser.parse_substitution(entity.get_attr('from'))
        kwargs['dst'] = parser.parse_substitution(entity.get_attr('to'))
        return cls, kwargs

    @property
    def src(self) -> list[Substitution]:
        """Return the original name, as substitutions."""
        return self.__src

    @property
    def dst(self) -> list[Substitution]:
        """Return the new name, as substitutions."""
        return self.__dst

    def execute(self, context: LaunchContext) -> None:
        """
        Add the remapping; it precedes those of the nodes themselves.

        Parameters
        ----------
        context
            The launch context; its configuration `ros_remaps` holds the global remappings.

        """
        rule = (
            perform_substitutions(context, self.__src),
            perform_substitutions(context, self.__dst),
        )
        known = context.launch_configurations.get('ros_remaps', [])
        context.launch_configurations['ros_remaps'] = [*known, rule]
        context.run.note(source=rule[0], target=rule[1])
