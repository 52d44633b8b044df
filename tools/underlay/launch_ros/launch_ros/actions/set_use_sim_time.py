# SPDX-License-Identifier: Apache-2.0
"""The action that chooses the clock of the launch itself."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING, Union

from launch.action import Action
from launch.launch_context import LaunchContext
from launch.some_substitutions_type import SomeSubstitutionsType
from launch.utilities.type_utils import normalize_typed_substitution, perform_typed_substitution

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser


class SetUseSimTime(Action):
    """
    Chooses whether the launch's own ROS node follows the time of a simulation.

    The nodes that are launched are not affected; SetParameter('use_sim_time', True) does that.
    """

    def __init__(self, value: Union[bool, SomeSubstitutionsType], **kwargs: Any) -> None:
        """Create the action."""
        super().__init__(**kwargs)
        self.__value = normalize_typed_substitution(value, bool)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """Return the class, and what to construct it with, for an element of a launch file."""
        _, kwargs = super().parse(entity, parser)
        value = entity.get_attr('value', data_type=bool)
        kwargs['value'] = parser.parse_if_substitutions(value)
        return cls, kwargs

    @property
    def value(self) -> Any:
        """Return the value, or the substitutions that stand for it."""
        return self.__value

    def execute(self, context: LaunchContext) -> None:
        """Choose it, also for the node if it is there only later."""
        from launch_ros.ros_adapters import find_ros_adapter

        value = perform_typed_substitution(context, self.__value, bool)
        context.extend_globals({'launch_use_sim_time': value})
        adapter = find_ros_adapter(context)
        if adapter is not None:
            adapter.set_use_sim_time(value)
