# SPDX-License-Identifier: Apache-2.0
"""The behaviours that spin the robot in place, drive it straight, back it up, or wait."""

from __future__ import annotations

from dataclasses import dataclass
import math
from typing import Any

from nav2_behaviors.motion import drive_speed, motion_ahead, Turn, turn_rate
from nav2_behaviors.timed_behavior import (
    duration_message,
    LookAheadParameters,
    seconds,
    TimedBehavior,
)
from nav2_msgs.action import BackUp as BackUpAction
from nav2_msgs.action import DriveOnHeading as DriveOnHeadingAction
from nav2_msgs.action import Spin as SpinAction
from nav2_msgs.action import Wait as WaitAction
from nav2_util import parameter
from nav2_util.twist import Velocity

__all__ = ['BackUp', 'DriveOnHeading', 'DriveParameters', 'Spin', 'SpinParameters', 'Wait']


@dataclass(frozen=True)
class SpinParameters:
    """The parameters of Spin, without a prefix."""

    max_rotational_vel: float = parameter(1.0, 'The fastest turn (rad/s).', low=0.0)
    min_rotational_vel: float = parameter(0.4, 'The slowest turn (rad/s).', low=0.0)
    rotational_acc_lim: float = parameter(3.2, 'How fast it can stop (rad/s^2).', low=0.0)


class Spin(TimedBehavior):
    """Behaviour that rotates the robot in place by an angle, unless a collision is ahead."""

    action = SpinAction

    def configure(self) -> None:
        """Declare the parameters."""
        self._look = self.node.parameters.declare(LookAheadParameters)
        self._limits = self.node.parameters.declare(SpinParameters)

    def begin(self, goal: Any) -> None:
        """
        Check the angle, and record the initial yaw.

        Parameters
        ----------
        goal
            The goal of the action: an angle in rad, positive to the left.

        Raises
        ------
        ActionAborted
            The angle is not finite, or the robot's pose is not available.

        """
        if not math.isfinite(goal.target_yaw):
            raise self.abort('UNKNOWN', f"'{self.name}' cannot turn by {goal.target_yaw} rad.")
        self._turn = Turn(goal.target_yaw, self.pose().yaw)

    def step(self, elapsed_s: float) -> bool:
        """
        Publish the next angular velocity, lower near the end.

        Parameters
        ----------
        elapsed_s
            The time since the start of the goal, in s of the node's clock.

        Returns
        -------
        bool
            Whether the angle is reached.

        Raises
        ------
        ActionAborted
            A collision is ahead, or the robot's pose is not available.

        """
        turn, limits = self._turn, self._limits.current
        turn.update(self.pose().yaw)
        self.server.publish_feedback(
            SpinAction.Feedback(angular_distance_traveled=turn.turned_rad)
        )
        if turn.is_done:
            return True
        rate = turn_rate(
            turn.remaining_rad,
            limits.max_rotational_vel,
            limits.min_rotational_vel,
            limits.rotational_acc_lim,
        )
        velocity = Velocity(yaw=math.copysign(rate, turn.target_rad))
        until_s = turn.remaining_rad / rate if rate else 0.0
        period_s = 1.0 / self.node.told.current.cycle_frequency
        horizon_s = self._look.current.simulate_ahead_time
        _, poses = motion_ahead(velocity, horizon_s, period_s, until_s)
        self.check_ahead(poses)
        self.drive(velocity)
        return False


@dataclass(frozen=True)
class DriveParameters:
    """Parameters of driving straight, `<name of the behaviour>.*`."""

    acceleration_limit: float = parameter(
        2.5, 'How fast the speed grows (m/s^2); 0 for at once.', low=0.0
    )
    deceleration_limit: float = parameter(
        -2.5, 'How fast the speed shrinks, negative (m/s^2); 0 for at once.', high=0.0
    )
    minimum_speed: float = parameter(
        0.1, 'The least speed at which the robot moves (m/s).', low=0.0
    )


class DriveOnHeading(TimedBehavior):
    """Behaviour that drives the robot straight by a distance, unless a collision is ahead."""

    action = DriveOnHeadingAction

    def configure(self) -> None:
        """Declare the parameters."""
        self._look = self.node.parameters.declare(LookAheadParameters)
        self._limits = self.node.parameters.declare(DriveParameters, prefix=self.name)

    def begin(self, goal: Any) -> None:
        """
        Check the target, and record the start pose.

        Parameters
        ----------
        goal
            The goal of the action: a target along x in m, and the speed in m/s.

        Raises
        ------
        ActionAborted
            The target or the speed is invalid, or the robot's pose is not available.

        """
        target, speed = goal.target, goal.speed
        if not all(map(math.isfinite, (target.x, target.y, target.z, speed))):
            raise self.abort('INVALID_INPUT', 'The target and the speed must be finite.')
        if target.y or target.z:
            raise self.abort(
                'INVALID_INPUT',
                f"'{self.name}' drives along x only; y and z of the target must be 0, but are "
                f'{target.y:g} and {target.z:g} m.',
            )
        self._distance_m, self._speed = self._command(target.x, speed)
        self._last_speed = 0.0
        self._start = self.pose()

    def step(self, elapsed_s: float) -> bool:
        """
        Publish the next velocity, lower at the start and near the end.

        Parameters
        ----------
        elapsed_s
            The time since the start of the goal, in s of the node's clock.

        Returns
        -------
        bool
            Whether the robot has travelled the distance.

        Raises
        ------
        ActionAborted
            A collision is ahead, or the robot's pose is not available.

        """
        limits = self._limits.current
        driven_m = self._start.distance_to(self.pose())
        self.server.publish_feedback(self.action.Feedback(distance_traveled=driven_m))
        remaining_m = self._distance_m - driven_m
        if remaining_m <= 0.0:
            return True
        period_s = 1.0 / self.node.told.current.cycle_frequency
        speed = drive_speed(
            self._speed,
            self._last_speed,
            remaining_m,
            acceleration=limits.acceleration_limit,
            deceleration=-limits.deceleration_limit,
            minimum_speed=limits.minimum_speed,
            period_s=period_s,
        )
        velocity = Velocity(x=math.copysign(speed, self._speed))
        horizon_s = self._look.current.simulate_ahead_time
        _, poses = motion_ahead(velocity, horizon_s, period_s, remaining_m / speed)
        self.check_ahead(poses)
        self._last_speed = speed
        self.drive(velocity)
        return False

    def _command(self, x: float, speed: float) -> tuple[float, float]:
        """Compute the signed distance in m and speed; raise ActionAborted if signs disagree."""
        if (x > 0.0) != (speed > 0.0) or (x and not speed):
            raise self.abort(
                'INVALID_INPUT',
                f"The signs of the target's x, {x:g} m, and of the speed, {speed:g} m/s, "
                'must be the same, and the speed must not be 0.',
            )
        return abs(x), speed


class BackUp(DriveOnHeading):
    """Behaviour that drives the robot straight backward; the signs in the goal are ignored."""

    action = BackUpAction

    def _command(self, x: float, speed: float) -> tuple[float, float]:
        if x and not speed:
            raise self.abort('INVALID_INPUT', 'The speed must not be 0.')
        return abs(x), -abs(speed)


class Wait(TimedBehavior):
    """Behaviour that keeps the robot waiting for a duration."""

    action = WaitAction

    def time_allowance_s(self, goal: Any) -> float:
        """
        Return 0: the duration of the wait is the only limit.

        Parameters
        ----------
        goal
            The goal message of the action.

        """
        return 0.0

    def begin(self, goal: Any) -> None:
        """
        Record how long to wait.

        Parameters
        ----------
        goal
            The goal of the action, with its duration.

        """
        self._duration_s = seconds(goal.time)

    def step(self, elapsed_s: float) -> bool:
        """
        Publish the remaining time as feedback.

        Parameters
        ----------
        elapsed_s
            The time since the start of the goal, in s of the node's clock.

        Returns
        -------
        bool
            Whether the time is over.

        """
        left_s = max(self._duration_s - elapsed_s, 0.0)
        self.server.publish_feedback(WaitAction.Feedback(time_left=duration_message(left_s)))
        return left_s == 0.0
