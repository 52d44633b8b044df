# SPDX-License-Identifier: Apache-2.0
"""Launch action that sets the log directory of nodes."""

from __future__ import annotations

import os
from typing import Any, TYPE_CHECKING

from launch.action import Action
from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType, Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser


class SetROSLogDir(Action):
    """
    Sets ROS_LOG_DIR for the nodes that follow.

    Parameters
    ----------
    new_log_dir
        The directory; `~` is expanded. A relative path is below the current log directory.
    **kwargs
        As for `Action`: `condition`.

    """

    def __init__(self, new_log_dir: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__log_dir = normalize_to_list_of_substitutions(new_log_dir)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """
        Parse an element of a launch file into the class and its keyword arguments.

        Parameters
        ----------
        entity
            The `set_ros_log_dir` element, with the attribute `dir` or `new_log_dir`.
        parser
            Parses substitutions in its attributes.

        Returns
        -------
        tuple
            The class and the keyword arguments of its constructor.

        """
        _, kwargs = super().parse(entity, parser)
        path = entity.get_attr('dir', optional=True) or entity.get_attr('new_log_dir')
        kwargs['new_log_dir'] = parser.parse_substitution(path)
        return cls, kwargs

    @property
    def log_dir(self) -> list[Substitution]:
        """Return the path, as substitutions."""
        return self.__log_dir

    def execute(self, context: LaunchContext) -> None:
        """
        Set the environment variable ROS_LOG_DIR.

        Parameters
        ----------
        context
            The launch context; processes that follow inherit its environment.

        """
        from launch.logging import base_directory

        path = os.path.expanduser(perform_substitutions(context, self.__log_dir))
        context.environment['ROS_LOG_DIR'] = os.path.join(base_directory(), path)
