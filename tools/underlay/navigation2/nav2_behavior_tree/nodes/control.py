# SPDX-License-Identifier: Apache-2.0
"""
The sequences, fallbacks and parallels of BehaviorTree.CPP v4.

They tick in the order that its documentation describes.

See https://www.behaviortree.dev/docs/nodes-library.
"""

from __future__ import annotations

from typing import ClassVar

from nav2_behavior_tree.control_node import Control
from nav2_behavior_tree.node import NodeConfig
from nav2_behavior_tree.ports import in_port, Port
from nav2_behavior_tree.registry import register
from nav2_behavior_tree.status import NodeStatus

__all__ = [
    'Fallback',
    'Parallel',
    'ParallelAll',
    'ReactiveFallback',
    'ReactiveSequence',
    'Sequence',
    'SequenceWithMemory',
]

IDLE, RUNNING, SUCCESS, FAILURE, SKIPPED = tuple(NodeStatus)


class _InOrder(Control):
    """Base class of nodes that tick children in order while their status is `goes_on`."""

    goes_on: ClassVar[NodeStatus]
    ends: ClassVar[NodeStatus]
    keeps_place: ClassVar[bool] = False
    is_async: ClassVar[bool] = False

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._at = 0
        self._skipped = 0

    def on_tick(self) -> NodeStatus:
        """Tick the current child, and the next ones."""
        if self.state is not RUNNING:
            self._skipped = 0
        self.set_state(RUNNING)
        while self._at < len(self.children):
            child = self.children[self._at]
            was_idle = child.state is IDLE
            status = child.execute_tick()
            if status is RUNNING:
                return RUNNING
            if status is self.ends:
                return self._stop_here()
            self._at += 1
            self._skipped += status is SKIPPED
            if (
                self.is_async
                and status is self.goes_on
                and was_idle
                and self._at < len(self.children)
            ):
                self.context.is_woken = True
                return RUNNING
        skipped, self._at = self._skipped == len(self.children), 0
        return self.finish(SKIPPED if skipped else self.goes_on)

    def _stop_here(self) -> NodeStatus:
        if self.keeps_place:
            here = self._at
            for child in self.children[here:]:
                self.halt_child(child)
            return self.ends
        self._at = 0
        return self.finish(self.ends)

    def on_halt(self) -> None:
        """Halt all children; restart with the first one or continue with the current one."""
        if not self.keeps_place:
            self._at = 0
        super().on_halt()


@register()
class Sequence(_InOrder):
    """Succeeds when all children have succeeded in order; fails with the first that fails."""

    goes_on, ends = SUCCESS, FAILURE


@register()
class AsyncSequence(Sequence):
    """A Sequence that can be halted between two children."""

    is_async = True


@register()
class SequenceWithMemory(Sequence):
    """A Sequence that resumes with the child that failed, not with the first."""

    keeps_place = True


@register()
class Fallback(_InOrder):
    """Succeeds with the first child that succeeds; fails when all have failed."""

    goes_on, ends = FAILURE, SUCCESS


@register()
class AsyncFallback(Fallback):
    """A Fallback that can be halted between two children."""

    is_async = True


class _Reactive(Control):
    """Base class of reactive nodes, which tick all children from the first on at each tick."""

    goes_on: ClassVar[NodeStatus]
    ends: ClassVar[NodeStatus]

    def on_tick(self) -> NodeStatus:
        """Tick children until one is running, or ends the node."""
        self.set_state(RUNNING)
        all_skipped = True
        for child in self.children:
            status = child.execute_tick()
            all_skipped = all_skipped and status is SKIPPED
            if status is RUNNING:
                for other in self.children:
                    if other is not child:
                        self.halt_child(other)
                return RUNNING
            if status is self.ends:
                return self.finish(self.ends)
            if status is SKIPPED:
                self.halt_child(child)
        return self.finish(SKIPPED if all_skipped else self.goes_on)


@register()
class ReactiveSequence(_Reactive):
    """A Sequence that checks the earlier children again while a later one is running."""

    goes_on, ends = SUCCESS, FAILURE


@register()
class ReactiveFallback(_Reactive):
    """A Fallback that checks the earlier children again while a later one is running."""

    goes_on, ends = FAILURE, SUCCESS


@register()
class Parallel(Control):
    """
    Ticks all children, and ends when enough of them have succeeded or failed.

    Parameters
    ----------
    config
        As for `TreeNode`.

    """

    ports: ClassVar[dict[str, Port]] = {
        'success_count': in_port('whole', '-1', 'Successes for a success; -1: all, -2: but one.'),
        'failure_count': in_port('whole', '1', 'Failures for a failure; negative as above.'),
    }

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._ends: dict[int, NodeStatus] = {}

    def _needed(self, port: str) -> int:
        count, children = int(self.input(port)), len(self.children)
        needed = count if count >= 0 else max(children + count + 1, 0)
        if needed > children:
            raise self.error(f"'{port}' is {count}, but there are only {children} children.")
        return needed

    def on_tick(self) -> NodeStatus:
        """Tick the children that have not ended."""
        successes, failures = self._needed('success_count'), self._needed('failure_count')
        may_skip = int(self.input('success_count')) < 0
        self.set_state(RUNNING)
        skipped = 0
        for index, child in enumerate(self.children):
            if index not in self._ends:
                status = child.execute_tick()
                skipped += status is SKIPPED
                if status is SUCCESS or status is FAILURE:
                    self._ends[index] = status
            succeeded = list(self._ends.values()).count(SUCCESS)
            failed = len(self._ends) - succeeded
            if succeeded >= successes or (may_skip and 0 < successes <= succeeded + skipped):
                if skipped == len(self.children):
                    return self._end(SKIPPED)
                return self._end(SUCCESS)
            if len(self.children) - failed < successes or failed == failures > 0:
                return self._end(FAILURE)
        return self._end(SKIPPED) if skipped == len(self.children) else RUNNING

    def _end(self, status: NodeStatus) -> NodeStatus:
        self._ends.clear()
        return self.finish(status)

    def on_halt(self) -> None:
        """Halt all children."""
        self._ends.clear()
        super().on_halt()


@register()
class ParallelAll(Parallel):
    """Ticks all children until each has ended; fails if too many have failed."""

    ports: ClassVar[dict[str, Port]] = {
        'max_failures': in_port('whole', '1', 'Failures for a failure; -1: all.')
    }

    def on_tick(self) -> NodeStatus:
        """Tick the children that have not ended."""
        limit = self._needed('max_failures')
        self.set_state(RUNNING)
        skipped = 0
        for index, child in enumerate(self.children):
            if index not in self._ends:
                status = child.execute_tick()
                skipped += status is SKIPPED
                if status is SUCCESS or status is FAILURE:
                    self._ends[index] = status
        if skipped == len(self.children):
            return self._end(SKIPPED)
        if len(self._ends) + skipped < len(self.children):
            return RUNNING
        failed = list(self._ends.values()).count(FAILURE)
        return self._end(FAILURE if failed >= limit else SUCCESS)
