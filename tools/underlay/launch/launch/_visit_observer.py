# SPDX-License-Identifier: Apache-2.0
"""Interface of observers of a visit."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Optional, TYPE_CHECKING

if TYPE_CHECKING:
    from launch.launch_description_entity import LaunchDescriptionEntity


class VisitObserver:
    """Observer of visited entities; this base class ignores all notifications."""

    def enter(self, entity: LaunchDescriptionEntity) -> None:
        """
        Handle the start of the visit of an entity.

        Parameters
        ----------
        entity
            The entity that is about to be visited.

        """

    def leave(self, entity: LaunchDescriptionEntity) -> None:
        """
        Handle the end of the visit of an entity, unless it has failed.

        Parameters
        ----------
        entity
            The entity, which has been visited with all its sub-entities.

        """

    def expanded(self, text: str) -> None:
        """
        Handle the expansion of the expression of a condition.

        Parameters
        ----------
        text
            The expanded expression.

        """

    def decided(self, entity: LaunchDescriptionEntity, value: bool) -> None:
        """
        Handle the evaluation of the condition of an entity.

        Parameters
        ----------
        entity
            The entity that has the condition.
        value
            Whether the condition is fulfilled.

        """

    def note(self, **facts: Any) -> None:
        """
        Handle facts about the entity that is being visited.

        Parameters
        ----------
        **facts
            The facts by name; `launch._rehearsal.record` lists the names.

        """

    def note_waiting(self, event: str, entities: Iterable[LaunchDescriptionEntity]) -> None:
        """
        Handle the entities that the visited entity leaves waiting for an event.

        Parameters
        ----------
        event
            A description of the event.
        entities
            The entities that are visited on the event.

        """

    def environment_changes(self, environment: dict[str, str]) -> dict[str, Optional[str]]:
        """
        Compare the environment of a process with that at the start of the visit.

        Parameters
        ----------
        environment
            The variables of the process.

        Returns
        -------
        dict
            The variables that differ, None for those that are unset; always empty here.

        """
        return {}
