# SPDX-License-Identifier: Apache-2.0
"""What can be told to whoever watches a visit."""

from __future__ import annotations

from typing import TYPE_CHECKING

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
