# SPDX-License-Identifier: Apache-2.0
"""Progress checkers and goal checkers."""

from __future__ import annotations

from dataclasses import dataclass
import math
from typing import TYPE_CHECKING

from nav2_controller.control import Velocity
from nav2_util.geometry import angle_between, Pose2D
from nav2_util.parameters import parameter, Unsupported

if TYPE_CHECKING:
    from nav2_controller.plugins import PluginContext

__all__ = [
    'GoalChecker',
    'PoseProgressChecker',
    'PositionGoalChecker',
    'ProgressChecker',
    'SimpleGoalChecker',
    'SimpleProgressChecker',
    'StoppedGoalChecker',
]

_LATER: dict[str, str | Unsupported] = {
    'path_length_tolerance': Unsupported(
        'the goal counts as reached wherever on the path the robot is', (1.0,)
    ),
    'symmetric_yaw_tolerance': Unsupported(
        'only the orientation of the goal itself counts', (False,)
    ),
    'xy_goal_tolerance_buffer': 'a position that was reached stays so until a new goal',
}


@dataclass(frozen=True)
class SimpleProgressParameters:
    """The parameters of SimpleProgressChecker."""

    required_movement_radius: float = parameter(
        0.5, 'How far in m the robot has to move within the time.', low=0.0
    )
    movement_time_allowance: float = parameter(
        10.0, 'The time in s within which it has to move.', low=0.0
    )


@dataclass(frozen=True)
class PoseProgressParameters(SimpleProgressParameters):
    """The parameters of PoseProgressChecker."""

    required_movement_angle: float = parameter(
        0.5, 'Or how far in rad it has to turn within the time.', low=0.0
    )


@dataclass(frozen=True)
class PositionGoalParameters:
    """The parameters of PositionGoalChecker."""

    xy_goal_tolerance: float = parameter(
        0.25, 'The distance in m from the goal that is near enough.', low=0.0
    )
    stateful: bool = parameter(
        True, 'Whether a position once reached counts, while the robot still turns.'
    )


@dataclass(frozen=True)
class SimpleGoalParameters(PositionGoalParameters):
    """The parameters of SimpleGoalChecker."""

    yaw_goal_tolerance: float = parameter(
        0.25, "The angle in rad from the goal's orientation that is near enough.", low=0.0
    )


@dataclass(frozen=True)
class StoppedGoalParameters(SimpleGoalParameters):
    """The parameters of StoppedGoalChecker."""

    trans_stopped_velocity: float = parameter(
        0.25, 'The speed in m/s below which the robot has stopped.', low=0.0
    )
    rot_stopped_velocity: float = parameter(
        0.25, 'The angular velocity in rad/s below which it has stopped.', low=0.0
    )


class ProgressChecker:
    """Base class of progress checkers."""

    def reset(self) -> None:
        """Reset the checker for a new goal."""

    def check(self, pose: Pose2D, now_s: float) -> bool:
        """
        Whether the robot is still making progress.

        Parameters
        ----------
        pose
            The robot in the frame of the costmap.
        now_s
            The time of the node's clock in s; it may jump back.

        """
        raise NotImplementedError

    def reason(self) -> str:
        """Describe the lack of progress in a sentence."""
        return 'The robot makes no progress.'


class SimpleProgressChecker(ProgressChecker):
    """
    Progress checker that requires a minimum translation within a time.

    Parameters
    ----------
    context
        The name of the plugin, which is the prefix of its parameters.

    """

    kind = SimpleProgressParameters

    def __init__(self, context: PluginContext) -> None:
        self._parameters = context.declare(self.kind)
        self._start: tuple[Pose2D, float] | None = None

    def reset(self) -> None:
        """Reset the checker for a new goal."""
        self._start = None

    def check(self, pose: Pose2D, now_s: float) -> bool:
        """
        Whether the robot has moved far enough within the time, or the time is not over.

        Parameters
        ----------
        pose, now_s
            As for `ProgressChecker.check`.

        """
        if self._start is None or now_s < self._start[1] or self._has_moved(self._start[0], pose):
            self._start = pose, now_s
            return True
        return now_s - self._start[1] <= self._parameters.current.movement_time_allowance

    def reason(self) -> str:
        """Describe the lack of progress in a sentence."""
        current = self._parameters.current
        return (
            f'The robot did not move by {current.required_movement_radius:g} m within '
            f'{current.movement_time_allowance:g} s. It may be stuck.'
        )

    def _has_moved(self, start: Pose2D, pose: Pose2D) -> bool:
        return start.distance_to(pose) > self._parameters.current.required_movement_radius


class PoseProgressChecker(SimpleProgressChecker):
    """Progress checker that requires a minimum translation or rotation within a time."""

    kind = PoseProgressParameters

    def _has_moved(self, start: Pose2D, pose: Pose2D) -> bool:
        current = self._parameters.current
        assert isinstance(current, PoseProgressParameters)
        turned = abs(angle_between(start.yaw, pose.yaw)) > current.required_movement_angle
        return turned or super()._has_moved(start, pose)


class GoalChecker:
    """Base class of goal checkers."""

    def reset(self) -> None:
        """Reset the checker for a new goal."""

    def is_reached(self, pose: Pose2D, goal: Pose2D, velocity: Velocity) -> bool:
        """
        Whether the goal is reached.

        Parameters
        ----------
        pose, goal
            The robot and the goal in the frame of the costmap.
        velocity
            The velocity of the robot in its base frame.

        """
        raise NotImplementedError

    def tolerances(self) -> tuple[float, float]:
        """Return the goal tolerances of position in m and orientation in rad."""
        raise NotImplementedError


class PositionGoalChecker(GoalChecker):
    """
    Goal checker for the position only.

    Parameters
    ----------
    context
        The name of the plugin, which is the prefix of its parameters.

    """

    kind = PositionGoalParameters

    def __init__(self, context: PluginContext) -> None:
        self._parameters = context.declare(self.kind)
        context.unsupported(_LATER)
        self._is_there = False

    def reset(self) -> None:
        """Reset the checker for a new goal."""
        self._is_there = False

    def is_reached(self, pose: Pose2D, goal: Pose2D, velocity: Velocity) -> bool:
        """
        Whether the robot is within the position tolerance, or was so before if stateful.

        Parameters
        ----------
        pose, goal, velocity
            As for `GoalChecker.is_reached`.

        """
        current = self._parameters.current
        near = pose.distance_to(goal) <= current.xy_goal_tolerance
        self._is_there = near or (self._is_there and current.stateful)
        return self._is_there

    def tolerances(self) -> tuple[float, float]:
        """Return the goal tolerances of position in m and orientation in rad."""
        return self._parameters.current.xy_goal_tolerance, math.pi


class SimpleGoalChecker(PositionGoalChecker):
    """Goal checker for the position and orientation."""

    kind = SimpleGoalParameters

    def is_reached(self, pose: Pose2D, goal: Pose2D, velocity: Velocity) -> bool:
        """
        Whether the robot is within the position and orientation tolerances.

        Parameters
        ----------
        pose, goal, velocity
            As for `GoalChecker.is_reached`.

        """
        turn = abs(angle_between(pose.yaw, goal.yaw))
        return super().is_reached(pose, goal, velocity) and turn <= self.tolerances()[1]

    def tolerances(self) -> tuple[float, float]:
        """Return the goal tolerances of position in m and orientation in rad."""
        current = self._parameters.current
        assert isinstance(current, SimpleGoalParameters)
        return current.xy_goal_tolerance, current.yaw_goal_tolerance


class StoppedGoalChecker(SimpleGoalChecker):
    """Goal checker that also requires the robot to have stopped."""

    kind = StoppedGoalParameters

    def is_reached(self, pose: Pose2D, goal: Pose2D, velocity: Velocity) -> bool:
        """
        Whether the robot is within the position and orientation tolerances, and has stopped.

        Parameters
        ----------
        pose, goal, velocity
            As for `GoalChecker.is_reached`.

        """
        current = self._parameters.current
        assert isinstance(current, StoppedGoalParameters)
        return (
            super().is_reached(pose, goal, velocity)
            and velocity.linear <= current.trans_stopped_velocity
            and abs(velocity.yaw) <= current.rot_stopped_velocity
        )
