# SPDX-License-Identifier: Apache-2.0
"""Watch a visit and keep what happens as a tree."""

from __future__ import annotations

from collections.abc import Iterable
import os
from typing import Any, Optional

from launch._rehearsal.record import ConditionRecord, Record
from launch._visit_observer import VisitObserver
from launch.action import Action
from launch.launch_description_entity import LaunchDescriptionEntity

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
    """Makes a record of each action; what is no action belongs to the one around it."""

    def __init__(self) -> None:
        """Begin with an empty tree."""
        self.root = Record('launch')
        self._open = [self.root]
        self._environment = dict(os.environ)
        self._expanded: Optional[str] = None

    def enter(self, entity: LaunchDescriptionEntity) -> None:
        """Begin the record of an action."""
        record = self._open[-1]
        if isinstance(entity, Action):
            record = Record(type(entity).__name__, entity.call_site)
            if not (self._open[-1].action == 'GroupAction' and record.action in _SCOPES):
                self._open[-1].children.append(record)
        self._open.append(record)

    def leave(self, entity: LaunchDescriptionEntity) -> None:
        """End it."""
        self._open.pop()

    def expanded(self, text: str) -> None:
        """Keep what the expression of the next condition expanded to."""
        self._expanded = text

    def decided(self, entity: Any, value: bool) -> None:
        """Note the condition of the action that is being visited."""
        expression = entity.condition.describe()
        self._open[-1].condition = ConditionRecord(expression, self._expanded, value)
        self._expanded = None

    def note(self, **facts: Any) -> None:
        """Note facts about the action that is being visited."""
        self._open[-1].facts.update(facts)

    def note_waiting(self, event: str, entities: Iterable[LaunchDescriptionEntity]) -> None:
        """Note what the action leaves waiting for an event."""
        records = [_outline(each) for each in entities if isinstance(each, Action)]
        self._open[-1].waiting.append((event, records))

    def environment_changes(self, environment: dict[str, str]) -> dict[str, Optional[str]]:
        """Return the variables that a process has otherwise; None are those that it lacks."""
        before = self._environment
        changes: dict[str, Optional[str]] = {
            name: value for name, value in environment.items() if before.get(name) != value
        }
        changes.update({name: None for name in before if name not in environment})
        return dict(sorted(changes.items()))


def _outline(action: Action) -> Record:
    """Return the record of an action that is not visited, as far as it can be described."""
    record = Record(type(action).__name__, action.call_site, facts=action._outline())
    if action.condition is not None:
        record.condition = ConditionRecord(_described(action.condition), None, None)
    if not hasattr(action, 'launch_description_source'):
        record.children = [
            _outline(each)
            for each in action.get_sub_entities()
            if isinstance(each, Action) and type(each).__name__ not in _SCOPES
        ]
    for event, entities in action._outline_of_waiting():
        records = [_outline(each) for each in entities if isinstance(each, Action)]
        record.waiting.append((event, records))
    return record


def _described(condition: Any) -> str:
    return str(condition.describe()) if hasattr(condition, 'describe') else repr(condition)
