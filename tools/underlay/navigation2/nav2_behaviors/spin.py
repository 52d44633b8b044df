# SPDX-License-Identifier: Apache-2.0
"""The behaviour that rotates the robot in place."""

from __future__ import annotations

from dataclasses import dataclass
import math
from typing import Any

from nav2_behaviors.motion import motion_ahead, Turn, turn_rate
from nav2_behaviors.timed_behavior import LookAheadParameters, TimedBehavior
from nav2_msgs.action import Spin as SpinAction
from nav2_util import parameter
from nav2_util.twist import Velocity

__all__ = ['Spin', 'SpinParameters']


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
