# SPDX-License-Identifier: Apache-2.0
"""
Base class of all tree nodes: a py_trees behaviour with the semantics of BehaviorTree.CPP.

It differs from that of py_trees in that a parent ticks and resets its children itself, that a node
keeps its state until then, and that it can be skipped. The py_trees tools that inspect trees
(display, visitors, `BehaviourTree`) work with them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any, ClassVar

from nav2_behavior_tree.blackboard import Blackboard
from nav2_behavior_tree.ports import Binding, convert, Port
from nav2_behavior_tree.scripting import Script
from nav2_behavior_tree.status import (
    Failure,
    NodeStatus,
    PY_TREES_STATUS,
    StatusChange,
    TreeError,
)
from nav2_util.errors import NavigationError
from py_trees.behaviour import Behaviour
from py_trees.common import Status

__all__ = ['NodeConfig', 'TreeContext', 'TreeNode']

IDLE, RUNNING, SUCCESS, FAILURE, SKIPPED = tuple(NodeStatus)
_MISSING = object()


@dataclass
class TreeContext:
    """
    Context that the nodes of a tree share besides the blackboard.

    Parameters
    ----------
    now_s
        The clock of the tree, in s.
    ros
        A `RosInterface` for nodes that use ROS; None without such nodes.

    """

    now_s: Callable[[], float]
    ros: Any = None
    tick: int = 0
    """The number of ticks of the tree so far."""
    is_woken: bool = False
    """Whether a node requests another tick immediately."""
    changes: list[StatusChange] = field(default_factory=list)
    """Status changes since they were last taken from this list."""
    failure: Failure | None = None
    """The most recent failure reported by an action, service or condition."""


@dataclass(frozen=True)
class NodeConfig:
    """Configuration of a node, which the builder of a tree passes to it."""

    type_name: str
    name: str
    uid: int
    context: TreeContext
    blackboard: Blackboard
    bindings: dict[str, Binding]
    scripts: dict[str, Script]
    file: str
    line: int


class TreeNode(Behaviour):
    """
    Base class of nodes. Subclasses override `on_tick`, and `on_halt` if they have work to stop.

    Parameters
    ----------
    config
        The name, ports and location of the node.

    """

    ports: ClassVar[dict[str, Port]] = {}
    """The ports of the node: its attributes in an XML file."""
    least_children: ClassVar[int] = 0
    most_children: ClassVar[int] = 0

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config.name)
        self.config, self.context, self.blackboard = config, config.context, config.blackboard
        self.state = IDLE
        self.is_fresh = True
        """Whether this tick is the first one after at least one tick of the tree without it."""
        self._last_tick = -2
        scripts = config.scripts
        self._before = {name: scripts[name] for name in PRECONDITIONS if name in scripts}
        self._after = {name: scripts[name] for name in POSTCONDITIONS if name in scripts}

    def on_tick(self) -> NodeStatus:
        """Run one tick, without blocking."""
        raise NotImplementedError

    def on_halt(self) -> None:
        """Stop the work in progress; called only while the node is running."""

    def on_new_goal(self) -> None:
        """Reset counters and timers that belong to another goal; the node may be running."""

    def execute_tick(self) -> NodeStatus:
        """Tick the node, and return its new status; SKIPPED is not stored."""
        tick = self.context.tick
        self.is_fresh = self.state is IDLE and tick - self._last_tick > 1
        self._last_tick = tick
        status = self._check_preconditions() if self._before else None
        if status is None:
            try:
                status = self.on_tick()
            except TreeError:
                raise
            except NavigationError as error:
                self.fail(str(error))
                status = FAILURE
        if self._after and (status is SUCCESS or status is FAILURE):
            self._run_after('_onSuccess' if status is SUCCESS else '_onFailure', '_post')
        if status is not SKIPPED:
            self.set_state(status)
        return status

    def halt_node(self) -> None:
        """Halt the node if it is running."""
        self.on_halt()
        self._run_after('_onHalted')

    def set_state(self, state: NodeStatus) -> None:
        """
        Set the status, and record a change of it.

        Parameters
        ----------
        state
            The new status.

        """
        if state is not self.state:
            context, config = self.context, self.config
            context.changes.append(
                StatusChange(context.now_s(), self.name, config.uid, self.state, state)
            )
            self.state = state
            self.status = PY_TREES_STATUS[state]

    def fail(self, message: str, code: int = 0) -> None:
        """
        Record the error message of a failure, as the reason that the tree reports if it fails.

        It does not set the status; `on_tick` has to return FAILURE.

        Parameters
        ----------
        message
            The error message, a full sentence.
        code
            The error code of the action; 0 if there is none.

        """
        self.feedback_message = message
        self.context.failure = Failure(self.name, code, message)

    def input(self, name: str) -> Any:  # noqa: A003, RUF100
        """
        Get the value of an input port; None if it is neither set nor has a default.

        Parameters
        ----------
        name
            The name of the port.

        Raises
        ------
        TreeError
            The value of its key cannot be converted to the type of the port.

        """
        key, value, kind = self.config.bindings[name]
        if key is None:
            return value
        value = self.blackboard.get(key, _MISSING)
        if value is _MISSING:
            return self._default(name)
        if value.__class__ is str and kind != 'text' and kind != 'any':
            try:
                return convert(value, kind)
            except ValueError as error:
                raise self.error(f"The value of '{{{key}}}' for '{name}' {error}.") from error
        return value

    def required(self, name: str) -> Any:
        """
        Get the value of a mandatory input port.

        Parameters
        ----------
        name
            The name of the port.

        Raises
        ------
        NavigationError
            Its key has no value; the node then fails.

        """
        value = self.input(name)
        if value is None:
            key = self.config.bindings[name].key
            raise NavigationError(
                f"'{self.name}' needs '{name}', and nothing has set '{{{key or name}}}' yet."
            )
        return value

    def output(self, name: str, value: Any) -> None:
        """
        Set the value of an output port, if it is bound to a key.

        Parameters
        ----------
        name
            The name of the port.
        value
            The value to write to the blackboard.

        """
        key = self.config.bindings[name].key
        if key is not None:
            self.blackboard.set(key, value)

    def error(self, message: str) -> TreeError:
        """
        Make an error that states the location of this node in its file.

        Parameters
        ----------
        message
            The error message, a full sentence.

        """
        return TreeError(message, self.config.file, self.config.line)

    def _default(self, name: str) -> Any:
        port = self.ports.get(name)
        if port is None or not isinstance(port.default, str) or port.default.startswith('{'):
            return None if port is None or isinstance(port.default, str) else _plain(port.default)
        return convert(port.default, port.kind)

    def _check_preconditions(self) -> NodeStatus | None:
        """Evaluate the preconditions; return the status that replaces a tick, if any."""
        for name, script in self._before.items():
            if self.state is IDLE:
                holds = bool(script(self.blackboard))
                if holds and name != '_while':
                    return _INSTEAD[name]
                if not holds and name == '_while':
                    return SKIPPED
            elif self.state is RUNNING and name == '_while' and not script(self.blackboard):
                self.halt_node()
                self.set_state(IDLE)
                return SKIPPED
        return None

    def _run_after(self, *names: str) -> None:
        for name in names:
            if name in self._after:
                self._after[name](self.blackboard)

    def update(self) -> Status:
        """Tick as in py_trees."""
        return PY_TREES_STATUS[self.execute_tick()]

    def tick(self) -> Iterator[Behaviour]:
        """Tick as in py_trees."""
        self.execute_tick()
        yield self

    def stop(self, new_status: Status) -> None:
        """
        Halt as in py_trees.

        Parameters
        ----------
        new_status
            The status given by py_trees; it is ignored, as the node is IDLE afterwards.

        """
        if self.state is RUNNING:
            self.halt_node()
        self.set_state(IDLE)


def _plain(default: Any) -> Any:
    return default if isinstance(default, (int, float, bool)) else None


_INSTEAD = {'_failureIf': FAILURE, '_successIf': SUCCESS, '_skipIf': SKIPPED}
PRECONDITIONS = ('_failureIf', '_successIf', '_skipIf', '_while')
POSTCONDITIONS = ('_onHalted', '_onFailure', '_onSuccess', '_post')
