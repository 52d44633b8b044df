# SPDX-License-Identifier: Apache-2.0
"""What can be told to whoever watches a visit."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Optional, TYPE_CHECKING

if TYPE_CHECKING:
    from launch.launch_description_entity import LaunchDescriptionEntity


class VisitObserver:
    """Is told about each entity; this one ignores it all."""

    def enter(self, entity: LaunchDescriptionEntity) -> None:
        """Hear that an entity is about to be visited."""

    def leave(self, entity: LaunchDescriptionEntity) -> None:
        """Hear that an entity and all that it returned have been visited."""

    def expanded(self, text: str) -> None:
        """Hear what the expression of a condition expanded to."""

    def decided(self, entity: LaunchDescriptionEntity, value: bool) -> None:
        """Hear what the condition of an entity is."""

    def note(self, **facts: Any) -> None:
        """Hear facts about the entity that is being visited."""

    def note_waiting(self, event: str, entities: Iterable[LaunchDescriptionEntity]) -> None:
        """Hear what the entity leaves waiting for an event."""

    def environment_changes(self, environment: dict[str, str]) -> dict[str, Optional[str]]:
        """Return how an environment differs from that at the start; None stands for unset."""
        return {}
