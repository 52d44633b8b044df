# SPDX-License-Identifier: Apache-2.0
"""
The control nodes of Nav2: pipelines, recoveries, and round robin.

See https://docs.nav2.org/behavior_trees/overview/nav2_specific_nodes.html.
"""

from __future__ import annotations

from typing import ClassVar

from nav2_behavior_tree.control_node import Control
from nav2_behavior_tree.node import NodeConfig
from nav2_behavior_tree.ports import in_port, Port
from nav2_behavior_tree.registry import register
from nav2_behavior_tree.status import NodeStatus

__all__ = [
    'NonblockingSequence',
    'PersistentSequence',
    'PipelineSequence',
    'RecoveryNode',
    'RoundRobin',
]

IDLE, RUNNING, SUCCESS, FAILURE, SKIPPED = tuple(NodeStatus)


@register()
class PipelineSequence(Control):
    """
    Ticks the earlier children again while a later one is running, unless one of them fails.

    A child is first ticked when the one before it has succeeded once. The node fails with the
    first child that fails, and succeeds with the last one.

    Parameters
    ----------
    config
        As for `TreeNode`.

    """

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._furthest = 0

    def on_tick(self) -> NodeStatus:
        """Tick the children from the first to the furthest one that is running."""
        self.set_state(RUNNING)
        skipped = 0
        for index, child in enumerate(self.children):
            status = child.execute_tick()
            if status is FAILURE:
                return self._end(FAILURE)
            if status is RUNNING and index >= self._furthest:
                self._furthest = index
                return RUNNING
            skipped += status is SKIPPED
        return self._end(SKIPPED if skipped == len(self.children) else SUCCESS)

    def _end(self, status: NodeStatus) -> NodeStatus:
        self._furthest = 0
        return self.finish(status)

    def on_halt(self) -> None:
        """Halt all children; restart with the first one."""
        self._furthest = 0
        super().on_halt()


@register()
class NonblockingSequence(Control):
    """Ticks all children at each tick, even after a running one, until all have succeeded."""

    def on_tick(self) -> NodeStatus:
        """Tick all children that have not succeeded in this round."""
        self.set_state(RUNNING)
        running = skipped = 0
        for child in self.children:
            status = child.execute_tick()
            if status is FAILURE:
                return self.finish(FAILURE)
            running += status is RUNNING
            skipped += status is SKIPPED
        if running:
            return RUNNING
        return self.finish(SKIPPED if skipped == len(self.children) else SUCCESS)


@register()
class PersistentSequence(Control):
    """A Sequence whose current child index is on the blackboard and persists."""

    ports: ClassVar[dict[str, Port]] = {
        'current_child_idx': in_port('natural', '{current_child_idx}', 'The child to go on with.')
    }

    def on_tick(self) -> NodeStatus:
        """Continue with the child whose index is on the blackboard."""
        self.set_state(RUNNING)
        at = int(self.input('current_child_idx') or 0)
        while at < len(self.children):
            status = self.children[at].execute_tick()
            if status is RUNNING:
                return RUNNING
            if status is FAILURE:
                return self.finish(FAILURE)
            at += 1
            self.output('current_child_idx', at)
        self.output('current_child_idx', 0)
        return self.finish(SUCCESS)


@register()
class RecoveryNode(Control):
    """
    Runs the first child; each time it fails, runs the second one, then retries the first.

    Succeeds if the first child does. Fails if the first one has failed `number_of_retries` times
    after a recovery, or if the second one fails.

    Parameters
    ----------
    config
        As for `TreeNode`.

    """

    least_children = most_children = 2
    ports: ClassVar[dict[str, Port]] = {
        'number_of_retries': in_port('natural', '1', 'How often to recover.')
    }

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._at = self._retries = 0

    def on_tick(self) -> NodeStatus:
        """Tick the current child; the other one may follow in the same tick."""
        limit = self.input('number_of_retries')
        self.set_state(RUNNING)
        while True:
            child = self.children[self._at]
            status = child.execute_tick()
            if status is RUNNING:
                return RUNNING
            if self._at == 0:
                if status is not FAILURE or self._retries >= limit:
                    return self._end(status)
                self._at = 1
            else:
                if status is not SUCCESS:
                    return self._end(FAILURE)
                self._retries += 1
                self._at = 0
            self.halt_child(child)

    def on_new_goal(self) -> None:
        """Reset the number of retries."""
        self._retries = 0

    def _end(self, status: NodeStatus) -> NodeStatus:
        self._at = self._retries = 0
        return self.finish(status)

    def on_halt(self) -> None:
        """Halt the children, and reset the number of retries."""
        self._at = self._retries = 0
        super().on_halt()


@register()
class RoundRobin(Control):
    """
    Ticks the next child each time, and the one after it if that fails; fails when all have.

    Parameters
    ----------
    config
        As for `TreeNode`.

    """

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._at = self._failed = self._skipped = 0

    def on_tick(self) -> NodeStatus:
        """Tick the current child."""
        self.set_state(RUNNING)
        count = len(self.children)
        while self._failed + self._skipped < count:
            status = self.children[self._at].execute_tick()
            if status is RUNNING:
                return RUNNING
            self._at = (self._at + 1) % count
            if status is SUCCESS:
                self._failed = self._skipped = 0
                return self.finish(SUCCESS)
            self._failed += status is FAILURE
            self._skipped += status is SKIPPED
        status = SKIPPED if self._skipped == count else FAILURE
        self.on_halt()
        return status

    def on_halt(self) -> None:
        """Halt the children; restart with the first one."""
        self._at = self._failed = self._skipped = 0
        super().on_halt()
