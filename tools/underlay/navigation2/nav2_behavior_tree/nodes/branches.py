# SPDX-License-Identifier: Apache-2.0
"""
The control nodes of BehaviorTree.CPP v4 that choose between children.

See https://www.behaviortree.dev/docs/nodes-library.
"""

from __future__ import annotations

from typing import ClassVar

from nav2_behavior_tree.control_node import Control
from nav2_behavior_tree.node import NodeConfig
from nav2_behavior_tree.ports import in_port, REQUIRED
from nav2_behavior_tree.registry import register
from nav2_behavior_tree.scripting import NAMES
from nav2_behavior_tree.status import NodeStatus

__all__ = ['IfThenElse', 'Switch', 'WhileDoElse']

RUNNING, SUCCESS, FAILURE, SKIPPED = tuple(NodeStatus)[1:]


@register()
class IfThenElse(Control):
    """
    Ticks the first child as a condition once, then runs the second or the third until it ends.

    Parameters
    ----------
    config
        As for `TreeNode`.

    """

    least_children, most_children = 2, 3

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._at = 0

    def on_tick(self) -> NodeStatus:
        """Evaluate the condition, or continue with the chosen child."""
        self.set_state(RUNNING)
        if self._at == 0:
            status = self.children[0].execute_tick()
            if status is RUNNING:
                return RUNNING
            if status is SUCCESS:
                self._at = 1
            elif status is FAILURE and len(self.children) > 2:
                self._at = 2
            else:
                return self.finish(status)
        status = self.children[self._at].execute_tick()
        if status is RUNNING:
            return RUNNING
        self._at = 0
        return self.finish(status)

    def on_halt(self) -> None:
        """Halt the children; the condition is evaluated again next time."""
        self._at = 0
        super().on_halt()


@register()
class WhileDoElse(Control):
    """Evaluates the first child at each tick; then runs the second on success, else the third."""

    least_children, most_children = 2, 3

    def on_tick(self) -> NodeStatus:
        """Evaluate the condition, halt the branch that is not chosen, and tick the chosen one."""
        self.set_state(RUNNING)
        status = self.children[0].execute_tick()
        if status is RUNNING:
            return RUNNING
        if status is SKIPPED:
            return self.finish(SKIPPED)
        chosen, other = (1, 2) if status is SUCCESS else (2, 1)
        if other < len(self.children):
            self.halt_child(self.children[other])
        if chosen >= len(self.children):
            return self.finish(FAILURE)
        status = self.children[chosen].execute_tick()
        return RUNNING if status is RUNNING else self.finish(status)


class Switch(Control):
    """
    Runs the child whose case matches the value of a variable; the last child if none does.

    Parameters
    ----------
    config
        As for `TreeNode`.

    """

    cases: ClassVar[int]

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._running: int | None = None

    def on_tick(self) -> NodeStatus:
        """Choose a child, halt another one that is running, and tick it."""
        self.set_state(RUNNING)
        chosen = self._chosen()
        if self._running is not None and self._running != chosen:
            self.halt_child(self.children[self._running])
        status = self.children[chosen].execute_tick()
        if status is RUNNING:
            self._running = chosen
            return RUNNING
        self._running = None
        return self.finish(status)

    def _chosen(self) -> int:
        value = self.input('variable')
        if value is not None:
            for index in range(self.cases):
                if _matches(value, str(self.input(f'case_{index + 1}'))):
                    return index
        return self.cases

    def on_halt(self) -> None:
        """Halt the running child."""
        self._running = None
        super().on_halt()


def _matches(value: object, case: str) -> bool:
    """Whether a value matches that of a case: the same text, number or status name."""
    text = str(value).lower() if isinstance(value, bool) else str(value)
    if text == case:
        return True
    try:
        return float(text) == float(NAMES.get(case, case))
    except ValueError:
        return False


def _make_switch(cases: int) -> None:
    ports = {'variable': in_port('any', REQUIRED, 'The value that decides.')}
    for index in range(1, cases + 1):
        ports[f'case_{index}'] = in_port('any', REQUIRED, f'The value for child {index}.')
    body = {
        '__doc__': Switch.__doc__,
        'cases': cases,
        'ports': ports,
        'least_children': cases + 1,
        'most_children': cases + 1,
    }
    register()(type(f'Switch{cases}', (Switch,), body))


for _cases in range(2, 7):
    _make_switch(_cases)
