# SPDX-License-Identifier: Apache-2.0
"""Conditions on goals, paths, times and error codes."""

from __future__ import annotations

from typing import Any, ClassVar

from nav2_behavior_tree.action_node import ServiceNode
from nav2_behavior_tree.node import NodeConfig, TreeNode
from nav2_behavior_tree.ports import in_port, Port, REQUIRED
from nav2_behavior_tree.registry import register
from nav2_behavior_tree.status import NodeStatus
from nav2_msgs.action import (
    ComputePathThroughPoses,
    ComputePathToPose,
    FollowPath,
    SmoothPath,
)
from nav2_msgs.srv import IsPathValid as IsPathValidService

__all__ = [
    'AreErrorCodesPresent',
    'GloballyUpdatedGoal',
    'GoalUpdated',
    'InitialPoseReceived',
    'IsPathValid',
    'PathExpiringTimer',
    'TimeExpired',
]

RUNNING, SUCCESS, FAILURE = NodeStatus.RUNNING, NodeStatus.SUCCESS, NodeStatus.FAILURE
_GOALS: dict[str, Port] = {
    'goal': in_port('pose', '{goal}', 'The goal.'),
    'goals': in_port('poses', '{goals}', 'The goals.'),
}


def outcome(holds: bool) -> NodeStatus:
    """
    Convert a bool to the status of a condition.

    Parameters
    ----------
    holds
        Whether the condition holds: SUCCESS, or FAILURE if not.

    """
    return SUCCESS if holds else FAILURE


@register('GloballyUpdatedGoal', 'GlobalUpdatedGoal')
class GloballyUpdatedGoal(TreeNode):
    """
    Succeeds if the goal has changed since this node was last ticked.

    Parameters
    ----------
    config
        As for `TreeNode`.

    """

    ports: ClassVar[dict[str, Port]] = _GOALS

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._known: tuple[Any, Any] | None = None

    def on_tick(self) -> NodeStatus:
        """Compare the goal with the previous one."""
        goal = self.input('goal'), self.input('goals')
        known, self._known = self._known, goal
        if known is None or all(new is old for new, old in zip(goal, known)):
            return FAILURE
        return outcome(goal != known)


@register()
class GoalUpdated(GloballyUpdatedGoal):
    """Succeeds if the goal has changed while the parent nodes were running."""

    def on_tick(self) -> NodeStatus:
        """Compare the goal with the previous one; the first tick only records it."""
        if self.is_fresh:
            self._known = None
        return super().on_tick()


@register()
class InitialPoseReceived(TreeNode):
    """Succeeds if the blackboard states that an initial pose was received."""

    ports: ClassVar[dict[str, Port]] = {
        'initial_pose_received': in_port('boolean', '{initial_pose_received}', 'Whether it was.')
    }

    def on_tick(self) -> NodeStatus:
        """Check the blackboard."""
        return outcome(bool(self.input('initial_pose_received')))


@register()
class IsPathValid(ServiceNode):
    """
    Succeeds if a path is free of obstacles.

    Later ticks return the last response and send a new request; only the first one waits.

    Parameters
    ----------
    config
        As for `ServiceNode`.

    """

    service, default_service = IsPathValidService, 'is_path_valid'
    ports: ClassVar[dict[str, Port]] = {
        'path': in_port('path', '{path}', 'The path.'),
        'service_name': in_port('text', '', 'The name of the service; empty: the usual one.'),
        'server_timeout': in_port('milliseconds', None, "Time to answer; the navigator's."),
        'max_cost': in_port('whole', '253', 'No effect: not in Jazzy.'),
        'consider_unknown_as_obstacle': in_port('boolean', 'false', 'No effect: not in Jazzy.'),
    }

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._known: NodeStatus | None = None

    def on_tick(self) -> NodeStatus:
        """Return the last response, or wait for the first one."""
        if self.is_fresh or self.input('path') is not self._path():
            self._known = None
        if self._known is not None and self._future is not None:
            if self._future.done():
                self._known = self.on_answer(self._future.result())
                self._future = None
            return self._known
        status = super().on_tick()
        if status is not RUNNING:
            self._known = status
        elif self._known is not None:
            return self._known
        return status

    def _path(self) -> Any:
        return None if self._request is None else self._request.path

    def make_request(self) -> Any:
        """Make the request with the path."""
        return IsPathValidService.Request(path=self.required('path'))

    def on_answer(self, response: Any) -> NodeStatus:
        """
        Convert the answer of the service to a status.

        Parameters
        ----------
        response
            The response of `nav2_msgs/IsPathValid`.

        Returns
        -------
        NodeStatus
            SUCCESS if the path is valid, else FAILURE.

        """
        return outcome(response.is_valid)

    def on_halt(self) -> None:
        """Forget the last response."""
        self._known = None
        super().on_halt()


@register()
class TimeExpired(TreeNode):
    """
    Succeeds each time a period has passed.

    Parameters
    ----------
    config
        As for `TreeNode`.

    """

    ports: ClassVar[dict[str, Port]] = {'seconds': in_port('number', '1.0', 'The time in s.')}

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._start_s = 0.0

    def on_tick(self) -> NodeStatus:
        """Check the clock; the first tick starts the timer."""
        now_s = self.context.now_s()
        if self.is_fresh or now_s < self._start_s:
            self._start_s = now_s
            return FAILURE
        if now_s - self._start_s < self.input('seconds'):
            return FAILURE
        self._start_s = now_s
        return SUCCESS


@register()
class PathExpiringTimer(TreeNode):
    """
    Succeeds when a path is older than a limit; a new path restarts the timer.

    Parameters
    ----------
    config
        As for `TreeNode`.

    """

    ports: ClassVar[dict[str, Port]] = {
        'seconds': in_port('number', '1.0', 'The time in s.'),
        'path': in_port('path', '{path}', 'The path.'),
    }

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._start_s = 0.0
        self._path: Any = None
        self._has_begun = False

    def on_tick(self) -> NodeStatus:
        """Check the path and the clock."""
        now_s, path = self.context.now_s(), self.input('path')
        if not self._has_begun or path is not self._path or now_s < self._start_s:
            self._has_begun, self._path, self._start_s = True, path, now_s
            return FAILURE
        if now_s - self._start_s < self.input('seconds'):
            return FAILURE
        self._start_s = now_s
        return SUCCESS


@register()
class AreErrorCodesPresent(TreeNode):
    """Succeeds if an error code is one of those to detect."""

    ports: ClassVar[dict[str, Port]] = {
        'error_code': in_port('natural', REQUIRED, 'The error code: {key}.'),
        'error_codes_to_check': in_port('codes', REQUIRED, 'Those to look for, as 101;107.'),
    }

    def on_tick(self) -> NodeStatus:
        """Compare the error codes."""
        codes = self.input('error_codes_to_check') or ()
        return outcome(self.input('error_code') in codes)


def _make_help(type_name: str, who: str, codes: frozenset[int]) -> None:
    ports: dict[str, Port] = {
        'error_code': in_port('natural', REQUIRED, f"The {who}'s error code: {{key}}."),
        'error_codes_to_check': in_port('codes', codes, 'Those that recoveries help with.'),
    }
    text = f"Succeeds if a recovery may help with an error code of the {who}'s."
    register()(type(type_name, (AreErrorCodesPresent,), {'__doc__': text, 'ports': ports}))


def _codes(kinds: tuple[Any, ...], *names: str) -> frozenset[int]:
    return frozenset(getattr(kind.Result, name) for kind in kinds for name in names)


_make_help(
    'WouldAControllerRecoveryHelp',
    'controller',
    _codes(
        (FollowPath,),
        'UNKNOWN',
        'PATIENCE_EXCEEDED',
        'FAILED_TO_MAKE_PROGRESS',
        'NO_VALID_CONTROL',
    ),
)
_make_help(
    'WouldAPlannerRecoveryHelp',
    'planner',
    _codes((ComputePathToPose, ComputePathThroughPoses), 'UNKNOWN', 'NO_VALID_PATH', 'TIMEOUT'),
)
_make_help(
    'WouldASmootherRecoveryHelp',
    'smoother',
    _codes(
        (SmoothPath,),
        'UNKNOWN',
        'TIMEOUT',
        'FAILED_TO_SMOOTH_PATH',
        'SMOOTHED_PATH_IN_COLLISION',
    ),
)
