# SPDX-License-Identifier: Apache-2.0
"""Launch action that selects the clock of the launch itself."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING, Union

from launch.action import Action
from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType
from launch.utilities.type_utils import normalize_typed_substitution, perform_typed_substitution

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser


class SetUseSimTime(Action):
    """
    Chooses whether the launch's own ROS node follows simulation time.

    Launched nodes are not affected; use SetParameter('use_sim_time', True) for them.

    Parameters
    ----------
    value
        Whether the clock of that node follows `/clock`.
    **kwargs
        As for `Action`: `condition`.

    Raises
    ------
    TypeError
        The value is neither a bool nor a string or substitution.

    """

    def __init__(self, value: Union[bool, SomeSubstitutionsType], **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__value = normalize_typed_substitution(value, bool)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """
        Parse an element of a launch file into the class and its keyword arguments.

        Parameters
        ----------
        entity
            The `set_use_sim_time` element, with the attribute `value`.
        parser
            Parses substitutions in its attributes.

        Returns
        -------
        tuple
            The class and the keyword arguments of its constructor.

        """
        _, kwargs = super().parse(entity, parser)
        value = entity.get_attr('value', data_type=bool)
        kwargs['value'] = parser.parse_if_substitutions(value)
        return cls, kwargs

    @property
    def value(self) -> Any:
        """Return the value, or the substitutions that evaluate to it."""
        return self.__value

    def execute(self, context: LaunchContext) -> None:
        """
        Select the clock, also for a node that is created later.

        Parameters
        ----------
        context
            The launch context; its global `launch_use_sim_time` stores the value.

        Raises
        ------
        ValueError
            The substituted value is not a boolean.

        """
        from launch_ros.ros_adapters import find_ros_adapter

        value = perform_typed_substitution(context, self.__value, bool)
        context.extend_globals({'launch_use_sim_time': value})
        adapter = find_ros_adapter(context)
        if adapter is not None:
            adapter.set_use_sim_time(value)
