# SPDX-License-Identifier: Apache-2.0
"""Detect when a launch is ready for its tests."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any, TYPE_CHECKING

from launch import Event, EventHandler
from launch.actions import IncludeLaunchDescription

if TYPE_CHECKING:
    from launch import LaunchContext, LaunchDescriptionEntity


class TestsMayBegin(Event):
    """
    A ReadyToTest action was visited.

    Parameters
    ----------
    action
        The action that was visited.

    """

    __test__ = False
    name = 'launch_testing.TestsMayBegin'

    def __init__(self, action: object) -> None:
        self.action = action


class ReadyHandler(EventHandler):
    """
    Event handler that calls a function as soon as all ReadyToTest actions have been visited.

    Parameters
    ----------
    description
        The launch description; included files are not searched.
    on_ready
        Called without arguments, and again on each later event.

    """

    def __init__(
        self,
        description: LaunchDescriptionEntity,
        on_ready: Callable[[], None],
    ) -> None:
        super().__init__(matcher=lambda event: isinstance(event, TestsMayBegin))
        self._missing = set(ready_actions([description]))
        self._on_ready = on_ready

    def handle(self, event: Any, context: LaunchContext) -> None:
        """
        Record that the action of the event was visited.

        Parameters
        ----------
        event
            A TestsMayBegin.
        context
            The context of the launch.

        """
        super().handle(event, context)
        self._missing.discard(event.action)
        if not self._missing:
            self._on_ready()


def ready_actions(entities: Iterable[LaunchDescriptionEntity]) -> Iterator[object]:
    """
    Yield all ReadyToTest actions that can be found without executing anything.

    Parameters
    ----------
    entities
        The entities to search, including their sub-entities but not included files.

    """
    from launch_testing.actions.ready_to_test import ReadyToTest

    for entity in entities:
        if isinstance(entity, ReadyToTest):
            yield entity
        elif not isinstance(entity, IncludeLaunchDescription):
            yield from ready_actions(entity.describe_sub_entities())
            for _, children in entity.describe_conditional_sub_entities():
                yield from ready_actions(children)
