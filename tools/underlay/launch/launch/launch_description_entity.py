# SPDX-License-Identifier: Apache-2.0
"""The base class of everything that a launch description may contain."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Optional, TYPE_CHECKING

if TYPE_CHECKING:
    import asyncio

    from launch.launch_context import LaunchContext


class LaunchDescriptionEntity:
    """
    Base class of the parts of a launch description; visiting an entity executes it.

    Attributes
    ----------
    runs_code_of_the_user
        Whether a visit runs a function of the launch file, which may do anything.
    declares_argument
        Whether it declares a launch argument, as `DeclareLaunchArgument` does.
    includes_file
        Whether its sub-entities are read from a launch file, as by `IncludeLaunchDescription`.
    resets_configurations
        Whether it removes launch configurations, as `ResetLaunchConfigurations` does.

    """

    runs_code_of_the_user = False
    declares_argument = False
    includes_file = False
    resets_configurations = False

    def visit(
        self,
        context: LaunchContext,
    ) -> Optional[Iterable[LaunchDescriptionEntity]]:
        """
        Execute the entity.

        Parameters
        ----------
        context
            The launch context.

        Returns
        -------
        iterable of LaunchDescriptionEntity or None
            The entities that are visited next.

        Raises
        ------
        NotImplementedError
            The class does not override it.

        """
        raise NotImplementedError(
            f"the class '{type(self).__name__}' does not define visit(context)"
        )

    def describe(self) -> str:
        """Return a short human-readable description."""
        return repr(self)

    def describe_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the sub-entities that are visited unconditionally."""
        return []

    def describe_conditional_sub_entities(
        self,
    ) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """Return the entities that may be visited, each list with a reason."""
        return []

    def check_in_advance(self, context: LaunchContext) -> None:
        """
        Raise an error if a later visit of the entity is certain to fail.

        Parameters
        ----------
        context
            The launch context, which is not changed.

        """

    def get_asyncio_future(self) -> Optional[asyncio.Future[Any]]:
        """Return a future that is done when the entity is complete; None if it is at once."""
        return None
