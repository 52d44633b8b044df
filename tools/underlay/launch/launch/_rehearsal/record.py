# SPDX-License-Identifier: Apache-2.0
"""
Record of one action in a dry run.

As data (`ros2 launch --dry-run --json`) each action has these keys; those that do not apply are
left out, and new ones may be added:

action      the name of its class; `launch` for the root, which also has `status`
error       of the root: the error message
file, line  where the launch file creates it
condition   expression, expanded (text or null) and value (true, false; null: not known yet)
actions     the list of actions visited below it
waiting     a list of `for`, a description of an event, and `actions`, described but not visited
name, value, is_default, text, path, namespace, function, scoped, forwarding, reason, event,
source, target
            the values that the action sets, logs, includes, calls or emits
label, argv, shell, cwd, environment
            of a process; the environment has the differences to that of the launcher (null: unset)
transition  of the event ChangeState
command     of a process that waits: the descriptions of its words
node_name, node_namespace, parameter_files, parameters, remappings
            of a node; the parameters are those that it sees, from all files and dictionaries
target_container, composable_nodes
            the container, and for each loaded node package, plugin and the keys of a node
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Optional

from launch._call_site import CallSite


@dataclass
class ConditionRecord:
    """A condition: its expression, the expanded text, and the value (None: not known yet)."""

    expression: str
    expanded: Optional[str]
    value: Optional[bool]


@dataclass
class Record:
    """Record of an action, with its facts, children and waiting entities."""

    action: str
    call_site: Optional[CallSite] = None
    condition: Optional[ConditionRecord] = None
    facts: dict[str, Any] = field(default_factory=dict)
    children: list[Record] = field(default_factory=list)
    waiting: list[tuple[str, list[Record]]] = field(default_factory=list)

    def as_data(self) -> dict[str, Any]:
        """Return the record as plain data, with the keys listed in the module docstring."""
        data: dict[str, Any] = {'action': self.action}
        if self.call_site is not None:
            data.update(file=self.call_site.file_name, line=self.call_site.line)
        if self.condition is not None:
            data['condition'] = dict(vars(self.condition))
        data.update(self.facts)
        if self.children:
            data['actions'] = [each.as_data() for each in self.children]
        if self.waiting:
            data['waiting'] = [
                {'for': event, 'actions': [each.as_data() for each in records]}
                for event, records in self.waiting
            ]
        return data
