# SPDX-License-Identifier: Apache-2.0
"""
What a rehearsal notes about one action.

As data (`ros2 launch --dry-run --json`) each action has these keys, of which those that do not
apply are left out; new ones may be added:

action      the name of its class; `launch` for the whole, which has also `status`
error       of the whole: the text of what has failed
file, line  where the launch file creates it
condition   expression, expanded (text or null) and value (true, false; null: not known yet)
actions     what was visited below it, a list of actions
waiting     a list of `for`, an event in words, and `actions`, which are described, not visited
name, value, is_default, text, path, namespace, function, scoped, forwarding, reason, event,
source, target
            what the action sets, logs, includes, calls or emits
label, argv, shell, cwd, environment
            of a process; the environment has what differs from that of the launcher (null: unset)
transition  of the event ChangeState
command     of a process that waits: its words, described
node_name, node_namespace, parameter_files, parameters, remappings
            of a node; the parameters are those that it sees, from all files and dictionaries
target_container, composable_nodes
            the container, and for each node that it loads package, plugin and what a node has
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Optional

from launch._call_site import CallSite


@dataclass
class ConditionRecord:
    """A condition: what it asks, what that expanded to, and the answer (None: not known yet)."""

    expression: str
    expanded: Optional[str]
    value: Optional[bool]


@dataclass
class Record:
    """An action, with all that came of it."""

    action: str
    call_site: Optional[CallSite] = None
    condition: Optional[ConditionRecord] = None
    facts: dict[str, Any] = field(default_factory=dict)
    children: list[Record] = field(default_factory=list)
    waiting: list[tuple[str, list[Record]]] = field(default_factory=list)

    def as_data(self) -> dict[str, Any]:
        """Return it as plain data; the keys stand above."""
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
