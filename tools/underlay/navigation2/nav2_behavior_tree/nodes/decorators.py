# SPDX-License-Identifier: Apache-2.0
"""
The decorators of BehaviorTree.CPP v4, which map the status of a child, repeat it or limit it.

See https://www.behaviortree.dev/docs/nodes-library/decoratornode.
"""

from __future__ import annotations

from typing import ClassVar

from nav2_behavior_tree.control_node import Decorator
from nav2_behavior_tree.node import NodeConfig
from nav2_behavior_tree.ports import in_port, Port, REQUIRED
from nav2_behavior_tree.registry import register
from nav2_behavior_tree.scripting import Script
from nav2_behavior_tree.status import NodeStatus

__all__ = [
    'Delay',
    'ForceFailure',
    'ForceSuccess',
    'Inverter',
    'KeepRunningUntilFailure',
    'Precondition',
    'Repeat',
    'RetryUntilSuccessful',
    'RunOnce',
    'Timeout',
]

IDLE, RUNNING, SUCCESS, FAILURE, SKIPPED = tuple(NodeStatus)


class _Mapping(Decorator):
    """Base class of decorators that map the final status of their child."""

    becomes: ClassVar[dict[NodeStatus, NodeStatus]]

    def on_tick(self) -> NodeStatus:
        """Tick the child."""
        self.set_state(RUNNING)
        status = self.child.execute_tick()
        if status is RUNNING or status is SKIPPED:
            return status
        return self.finish(self.becomes[status])


@register()
class Inverter(_Mapping):
    """Fails when its child succeeds, and vice versa."""

    becomes = {SUCCESS: FAILURE, FAILURE: SUCCESS}


@register()
class ForceSuccess(_Mapping):
    """Succeeds whatever the final status of its child."""

    becomes = {SUCCESS: SUCCESS, FAILURE: SUCCESS}


@register()
class ForceFailure(_Mapping):
    """Fails whatever the final status of its child."""

    becomes = {SUCCESS: FAILURE, FAILURE: FAILURE}


@register()
class KeepRunningUntilFailure(_Mapping):
    """Restarts its child until it fails."""

    becomes = {SUCCESS: RUNNING, FAILURE: FAILURE}


class _Again(Decorator):
    """Base class of decorators that restart their child after a certain status, up to a limit."""

    again: ClassVar[NodeStatus]
    counter: ClassVar[str]

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._count = 0

    def on_tick(self) -> NodeStatus:
        """Tick the child; start another round if its status requires it."""
        limit = self.input(self.counter)
        self.set_state(RUNNING)
        while limit == -1 or self._count < limit:
            was_idle = self.child.state is IDLE
            status = self.child.execute_tick()
            if status is RUNNING:
                return RUNNING
            self.halt_child(self.child)
            if status is SKIPPED:
                return SKIPPED
            if status is not self.again:
                self._count = 0
                return status
            self._count += 1
            if was_idle and (limit == -1 or self._count < limit):
                self.context.is_woken = True
                return RUNNING
        self._count = 0
        return self.again

    def on_halt(self) -> None:
        """Halt the child, and reset the count of rounds."""
        self._count = 0
        super().on_halt()


@register()
class Repeat(_Again):
    """Succeeds after a number of consecutive successes of its child."""

    again, counter = SUCCESS, 'num_cycles'
    ports: ClassVar[dict[str, Port]] = {
        'num_cycles': in_port('whole', REQUIRED, 'How often; -1: for ever.')
    }


@register()
class RetryUntilSuccessful(_Again):
    """Fails after a number of failures of its child."""

    again, counter = FAILURE, 'num_attempts'
    ports: ClassVar[dict[str, Port]] = {
        'num_attempts': in_port('whole', REQUIRED, 'How often; -1: for ever.')
    }


@register()
class Delay(Decorator):
    """
    Starts its child after a delay.

    Parameters
    ----------
    config
        As for `TreeNode`.

    """

    ports: ClassVar[dict[str, Port]] = {
        'delay_msec': in_port('milliseconds', REQUIRED, 'The time in ms.')
    }

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._end_s: float | None = None

    def on_tick(self) -> NodeStatus:
        """Wait, then tick the child."""
        now_s = self.context.now_s()
        if self._end_s is None:
            self._end_s = now_s + 1e-3 * self.required('delay_msec')
            self.set_state(RUNNING)
        if now_s < self._end_s:
            return RUNNING
        status = self.child.execute_tick()
        if status is RUNNING:
            return RUNNING
        self._end_s = None
        return self.finish(status)

    def on_halt(self) -> None:
        """Halt the child, and restart the delay next time."""
        self._end_s = None
        super().on_halt()


@register()
class Timeout(Decorator):
    """
    Halts its child and fails if it exceeds a time limit.

    Parameters
    ----------
    config
        As for `TreeNode`.

    """

    ports: ClassVar[dict[str, Port]] = {
        'msec': in_port('milliseconds', REQUIRED, 'The time in ms; 0: no limit.')
    }

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._end_s: float | None = None

    def on_tick(self) -> NodeStatus:
        """Tick the child until the time limit."""
        now_s, limit = self.context.now_s(), self.required('msec')
        if self._end_s is None:
            self._end_s = now_s + 1e-3 * limit
            self.set_state(RUNNING)
        if limit and now_s >= self._end_s and self.child.state is RUNNING:
            self._end_s = None
            self.fail(f"'{self.name}' stopped '{self.child.name}' after {1e-3 * limit:g} s.")
            return self.finish(FAILURE)
        status = self.child.execute_tick()
        if status is RUNNING:
            return RUNNING
        self._end_s = None
        return self.finish(status)

    def on_halt(self) -> None:
        """Halt the child."""
        self._end_s = None
        super().on_halt()


@register()
class RunOnce(Decorator):
    """
    Runs its child once; later it is skipped, or returns the same status again.

    Parameters
    ----------
    config
        As for `TreeNode`.

    """

    ports: ClassVar[dict[str, Port]] = {
        'then_skip': in_port('boolean', 'true', 'Whether to be skipped later.')
    }

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._end: NodeStatus | None = None

    def on_tick(self) -> NodeStatus:
        """Tick the child unless it has already ended."""
        if self._end is not None:
            return SKIPPED if self.input('then_skip') else self._end
        self.set_state(RUNNING)
        status = self.child.execute_tick()
        if status is SUCCESS or status is FAILURE:
            self._end = status
            return self.finish(status)
        return status


@register()
class Precondition(Decorator):
    """
    Runs its child if a script is true at the start; otherwise returns another status.

    Parameters
    ----------
    config
        As for `TreeNode`.

    Raises
    ------
    TreeError
        The script cannot be parsed, or `else` is not a status.

    """

    ports: ClassVar[dict[str, Port]] = {
        'if': in_port('text', REQUIRED, 'The script.'),
        'else': in_port('text', 'FAILURE', 'FAILURE, SUCCESS, SKIPPED or RUNNING.'),
    }

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._script = Script(self.input('if'), config.file, config.line)
        otherwise = self.input('else')
        if otherwise not in NodeStatus.__members__ or otherwise == 'IDLE':
            raise self.error(
                f"'else' must be FAILURE, SUCCESS, SKIPPED or RUNNING, but is '{otherwise}'."
            )
        self._else = NodeStatus[otherwise]
        self._has_begun = False

    def on_tick(self) -> NodeStatus:
        """Evaluate the script, then tick the child until it ends."""
        if not self._has_begun:
            if not self._script(self.blackboard):
                return self._else
            self._has_begun = True
        self.set_state(RUNNING)
        status = self.child.execute_tick()
        if status is RUNNING:
            return RUNNING
        self._has_begun = False
        return self.finish(status)

    def on_halt(self) -> None:
        """Halt the child, and evaluate the script again next time."""
        self._has_begun = False
        super().on_halt()


class _WhenUpdated(Decorator):
    """Base class of decorators that run their child when a blackboard entry was set again."""

    otherwise: ClassVar[NodeStatus]
    ports: ClassVar[dict[str, Port]] = {'entry': in_port('any', REQUIRED, 'The entry: {key}.')}

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._seen = 0
        if config.bindings['entry'].key is None:
            raise self.error("'entry' must be a key of the blackboard such as '{goal}'.")

    def on_tick(self) -> NodeStatus:
        """Check for an update of the entry, and tick the child."""
        if self.child.state is not RUNNING:
            version = self.blackboard.version(self.config.bindings['entry'].key or '')
            if version == self._seen:
                return self.otherwise
            self._seen = version
        self.set_state(RUNNING)
        status = self.child.execute_tick()
        return RUNNING if status is RUNNING else self.finish(status)


@register()
class SkipUnlessUpdated(_WhenUpdated):
    """Is skipped while an entry is not updated."""

    otherwise = SKIPPED


@register()
class WaitValueUpdate(_WhenUpdated):
    """Returns RUNNING while an entry is not updated."""

    otherwise = RUNNING
