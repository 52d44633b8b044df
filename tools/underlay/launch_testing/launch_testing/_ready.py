# SPDX-License-Identifier: Apache-2.0
"""Tell when the tests of a launch may begin."""

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
        That action.

    """

    __test__ = False
    name = 'launch_testing.TestsMayBegin'

    def __init__(self, action: object) -> None:
        self.action = action


class ReadyHandler(EventHandler):
    """
    Calls a function as soon as every ReadyToTest of a description was visited.

    Parameters
    ----------
    description
        What is launched; files that it includes are not searched.
    on_ready
        Called without arguments, and again for each event after that.

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
    Yield every ReadyToTest that can be found without executing anything.

    Parameters
    ----------
    entities
        Where to search, including what their actions hold; files that they include are left out.

    """
    from launch_testing.actions.ready_to_test import ReadyToTest

    for entity in entities:
        if isinstance(entity, ReadyToTest):
            yield entity
        elif not isinstance(entity, IncludeLaunchDescription):
            yield from ready_actions(entity.describe_sub_entities())
            for _, children in entity.describe_conditional_sub_entities():
                yield from ready_actions(children)
