# SPDX-License-Identifier: Apache-2.0
"""Dry run: visit a launch description without starting anything, and record each action."""

from __future__ import annotations

import asyncio
from collections.abc import Iterable
import os
from typing import Any, Optional, TYPE_CHECKING

from launch._event_processor import EventProcessor
from launch.action import Action
from launch.dry_run_record import ConditionRecord, Record
from launch.events import IncludeLaunchDescription
from launch.failures import error_text
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.launch_run import VisitObserver
from launch.logging import launch_config

if TYPE_CHECKING:
    from launch.launch_service import LaunchService

_SCOPES = frozenset(
    (
        'PopEnvironment',
        'PopLaunchConfigurations',
        'PushEnvironment',
        'PushLaunchConfigurations',
        'ResetEnvironment',
        'ResetLaunchConfigurations',
    )
)


class Recorder(VisitObserver):
    """Observer that records each action; other entities belong to the enclosing action."""

    def __init__(self) -> None:
        self.root = Record('launch')
        self._open = [self.root]
        self._environment = dict(os.environ)
        self._expanded: Optional[str] = None

    def enter(self, entity: LaunchDescriptionEntity) -> None:
        """
        Open the record of an entity that is about to be visited.

        Parameters
        ----------
        entity
            The entity; a non-action shares the record of the enclosing action.

        """
        record = self._open[-1]
        if isinstance(entity, Action):
            record = Record(type(entity).__name__, entity.call_site)
            if not (self._open[-1].action == 'GroupAction' and record.action in _SCOPES):
                self._open[-1].children.append(record)
        self._open.append(record)

    def leave(self, entity: LaunchDescriptionEntity) -> None:
        """
        Close the record of the entity that was entered last.

        Parameters
        ----------
        entity
            The entity, which is not used.

        """
        self._open.pop()

    def expanded(self, text: str) -> None:
        """
        Store an expanded expression for the record of its condition.

        Parameters
        ----------
        text
            The expanded text.

        """
        self._expanded = text

    def decided(self, entity: Any, value: bool) -> None:
        """
        Record the condition of the action that is being visited.

        Parameters
        ----------
        entity
            The action, which has a condition.
        value
            Whether the condition is fulfilled.

        """
        expression = entity.condition.describe()
        self._open[-1].condition = ConditionRecord(expression, self._expanded, value)
        self._expanded = None

    def note(self, **facts: Any) -> None:
        """
        Record facts about the action that is being visited.

        Parameters
        ----------
        **facts
            The facts by their keys in `launch.dry_run_record`.

        """
        self._open[-1].facts.update(facts)

    def note_waiting(self, event: str, entities: Iterable[LaunchDescriptionEntity]) -> None:
        """
        Record the entities that the visited action leaves waiting for an event.

        Parameters
        ----------
        event
            A description of the event.
        entities
            The entities that are visited on the event; only actions are recorded.

        """
        records = [_outline(each) for each in entities if isinstance(each, Action)]
        self._open[-1].waiting.append((event, records))

    def environment_changes(self, environment: dict[str, str]) -> dict[str, Optional[str]]:
        """
        Compare the environment of a process with that at the start of the dry run.

        Parameters
        ----------
        environment
            The variables of the process.

        Returns
        -------
        dict
            The variables that differ, sorted by name; None for those that the process lacks.

        """
        before = self._environment
        changes: dict[str, Optional[str]] = {
            name: value for name, value in environment.items() if before.get(name) != value
        }
        changes.update({name: None for name in before if name not in environment})
        return dict(sorted(changes.items()))


def _outline(action: Action) -> Record:
    """Return the record of an unvisited action, as far as it is known."""
    record = Record(type(action).__name__, action.call_site, facts=action.outline())
    if action.condition is not None:
        record.condition = ConditionRecord(_described(action.condition), None, None)
    if not hasattr(action, 'launch_description_source'):
        record.children = [
            _outline(each)
            for each in action.get_sub_entities()
            if isinstance(each, Action) and type(each).__name__ not in _SCOPES
        ]
    for event, entities in action.outline_of_waiting():
        records = [_outline(each) for each in entities if isinstance(each, Action)]
        record.waiting.append((event, records))
    return record


def _described(condition: Any) -> str:
    return str(condition.describe()) if hasattr(condition, 'describe') else repr(condition)


def rehearse(service: LaunchService) -> tuple[Record, int]:
    """
    Visit the launch description of a service without starting anything.

    The tasks of processes are created, but canceled before the event loop runs them. Nothing is
    written to log files.

    Parameters
    ----------
    service
        The service; the first description that was included in it is visited.

    Returns
    -------
    tuple
        The root of the tree of records, and the status that the launch would end with.

    """
    from launch.launch_service import cancel_all_tasks

    run, recorder = service.context.run, Recorder()
    launch_config.keep_nothing()
    loop = asyncio.new_event_loop()
    try:
        processor = EventProcessor(service.context, loop)
        run.attach(loop)
        run.observer = recorder
        while run.event_queue:
            event = run.event_queue.popleft()
            if isinstance(event, IncludeLaunchDescription):
                processor.handle(event)
                break
    finally:
        run.observer = None
        run.attach(None)
        cancel_all_tasks(loop)
        loop.close()
    if processor.first_error is not None:
        recorder.root.facts['error'] = error_text(processor.first_error)
    return recorder.root, processor.return_code
