# SPDX-License-Identifier: Apache-2.0
"""Decorators that limit how often their child runs: by rate, distance, speed, goal or once."""

from __future__ import annotations

from typing import Any, ClassVar

from nav2_behavior_tree.control_node import Decorator
from nav2_behavior_tree.geometry import path_length_m
from nav2_behavior_tree.node import NodeConfig
from nav2_behavior_tree.ports import in_port, Port
from nav2_behavior_tree.registry import register
from nav2_behavior_tree.status import NodeStatus
from nav2_util.geometry import path_poses, Pose2D

__all__ = [
    'DistanceController',
    'GoalUpdatedController',
    'PathLongerOnApproach',
    'RateController',
    'SingleTrigger',
    'SpeedController',
]

IDLE, RUNNING, SUCCESS, FAILURE, SKIPPED = tuple(NodeStatus)
_GOALS = {
    'goal': in_port('pose', '{goal}', 'The goal that may change.'),
    'goals': in_port('poses', '{goals}', 'The goals that may change.'),
}


class _Paced(Decorator):
    """Ticks its child at first, while it is running, and when it is due again after a success."""

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._is_first = True

    def begin(self) -> None:
        """Restart the measurement."""

    def is_due(self) -> bool:
        """Whether the child is due again."""
        raise NotImplementedError

    def on_new_goal(self) -> None:
        """Make the child due at the next tick."""
        self._is_first = True

    def on_tick(self) -> NodeStatus:
        """Tick the child if it is due; the node is running in between."""
        if self.state is IDLE:
            self.begin()
            self._is_first = True
        self.set_state(RUNNING)
        if not (self._is_first or self.child.state is RUNNING or self.is_due()):
            return RUNNING
        self._is_first = False
        status = self.child.execute_tick()
        if status is SUCCESS:
            self.begin()
        return status


@register()
class RateController(_Paced):
    """Runs its child at a limited rate."""

    ports: ClassVar[dict[str, Port]] = {'hz': in_port('number', '10.0', 'The rate in Hz.')}

    def begin(self) -> None:
        """Restart the period."""
        self._start_s = self.context.now_s()

    def is_due(self) -> bool:
        """Whether the period is over; also if the clock has jumped back."""
        passed_s = self.context.now_s() - self._start_s
        return bool(passed_s * self.input('hz') >= 1.0 or passed_s < 0.0)


@register()
class DistanceController(_Paced):
    """Runs its child each time the robot has travelled a distance."""

    ports: ClassVar[dict[str, Port]] = {
        'distance': in_port('number', '1.0', 'The way in m.'),
        'global_frame': in_port('text', '', "The frame of the way; empty: the navigator's."),
        'robot_base_frame': in_port('text', '', "The robot's frame; empty: the navigator's."),
    }

    def _pose(self) -> Pose2D:
        pose: Pose2D = self.context.ros.robot_pose(
            self.input('global_frame'), self.input('robot_base_frame')
        )
        return pose

    def begin(self) -> None:
        """Restart the distance at the current pose."""
        self._start = self._pose()

    def is_due(self) -> bool:
        """Whether the robot has travelled far enough."""
        return bool(self._start.distance_to(self._pose()) >= self.input('distance'))


@register()
class SpeedController(_Paced):
    """
    Runs its child at a rate that grows with the robot's speed, and immediately for a new goal.

    Parameters
    ----------
    config
        As for `TreeNode`; its context has a `RosInterface`.

    Raises
    ------
    TreeError
        A rate is not greater than 0, or the minimum speed is not below the maximum.

    """

    ports: ClassVar[dict[str, Port]] = {
        'min_rate': in_port('number', '0.1', 'The rate at min_speed in Hz.'),
        'max_rate': in_port('number', '1.0', 'The rate at max_speed in Hz.'),
        'min_speed': in_port('number', '0.0', 'In m/s.'),
        'max_speed': in_port('number', '0.5', 'In m/s.'),
        'filter_duration': in_port('number', '0.3', 'No effect: see the navigator.'),
        **_GOALS,
    }

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        if self.input('min_rate') <= 0.0 or self.input('max_rate') <= 0.0:
            raise self.error("'min_rate' and 'max_rate' must be greater than 0.")
        if self.input('max_speed') <= self.input('min_speed'):
            raise self.error("'max_speed' must be greater than 'min_speed'.")

    def begin(self) -> None:
        """Restart the period, at the rate of the current speed."""
        self._start_s = self.context.now_s()
        self._goal = self.input('goal'), self.input('goals')
        speed = abs(self.context.ros.speed_m_s())
        low, high = self.input('min_speed'), self.input('max_speed')
        share = min(max((speed - low) / (high - low), 0.0), 1.0)
        slow, fast = self.input('min_rate'), self.input('max_rate')
        self._period_s = 1.0 / (slow + share * (fast - slow))

    def is_due(self) -> bool:
        """Whether the period is over, or the goal has changed."""
        passed_s = self.context.now_s() - self._start_s
        goal = self.input('goal'), self.input('goals')
        if any(new is not old for new, old in zip(goal, self._goal)) and goal != self._goal:
            return True
        return passed_s >= self._period_s or passed_s < 0.0


@register()
class GoalUpdatedController(_Paced):
    """
    Runs its child at the start and for each new goal.

    Parameters
    ----------
    config
        As for `TreeNode`.

    """

    ports: ClassVar[dict[str, Port]] = _GOALS

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._goal: tuple[Any, Any] = (None, None)

    def on_new_goal(self) -> None:
        """Do nothing: `is_due` detects the new goal."""

    def begin(self) -> None:
        """Record the goal if none is recorded, so that a change during the run is detected."""
        if self.state is IDLE:
            self._goal = self.input('goal'), self.input('goals')

    def is_due(self) -> bool:
        """Whether the goal has changed."""
        goal = self.input('goal'), self.input('goals')
        if all(new is old for new, old in zip(goal, self._goal)) or goal == self._goal:
            return False
        self._goal = goal
        return True


@register()
class SingleTrigger(Decorator):
    """
    Runs its child once, and fails from then on.

    Parameters
    ----------
    config
        As for `TreeNode`.

    """

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._is_over = False

    def on_tick(self) -> NodeStatus:
        """Tick the child until it has ended."""
        if self.state is IDLE:
            self._is_over = False
        self.set_state(RUNNING)
        if self._is_over:
            return FAILURE
        status = self.child.execute_tick()
        self._is_over = status is SUCCESS or status is FAILURE
        return status


@register()
class PathLongerOnApproach(Decorator):
    """
    Runs its child if a new path to the same goal is much longer while the goal is near.

    Parameters
    ----------
    config
        As for `TreeNode`.

    """

    ports: ClassVar[dict[str, Port]] = {
        'path': in_port('path', '{path}', 'The path.'),
        'prox_len': in_port('number', '3.0', 'How long the old path is at most, in m.'),
        'length_factor': in_port('number', '2.0', 'How much longer the new one is at least.'),
    }

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._old: Any = None
        self._new: Any = None

    def on_tick(self) -> NodeStatus:
        """Compare the path with the previous one; tick the child until it has ended."""
        if self.child.state is not RUNNING:
            self._new = self.input('path')
            if not self._is_longer():
                self._old = self._new
                return SUCCESS
        self.set_state(RUNNING)
        status = self.child.execute_tick()
        if status is RUNNING or status is SKIPPED:
            return status
        self._old = self._new
        return self.finish(status)

    def _is_longer(self) -> bool:
        old, new = self._old, self._new
        if old is None or new is None or new is old or not old.poses or not new.poses:
            return False
        if old.poses[-1].pose != new.poses[-1].pose:
            return False
        before_m = path_length_m(path_poses(old))
        is_near = before_m < self.input('prox_len')
        after_m = path_length_m(path_poses(new))
        return bool(is_near and after_m > self.input('length_factor') * before_m)
