# SPDX-License-Identifier: Apache-2.0
"""The behaviour for assisted teleoperation, which slows the robot down before a collision."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from nav2_behaviors.collision_checker import CannotCheck
from nav2_behaviors.motion import motion_ahead
from nav2_behaviors.timed_behavior import duration_message, TimedBehavior
from nav2_msgs.action import AssistedTeleop as AssistedTeleopAction
from nav2_util import parameter
from nav2_util.twist import subscribe_twist, Velocity
from std_msgs.msg import Empty, Header

__all__ = ['AssistedTeleop', 'AssistedTeleopParameters']


@dataclass(frozen=True)
class AssistedTeleopParameters:
    """The parameters of assisted teleoperation, without a prefix."""

    projection_time: float = parameter(1.0, 'How far to look ahead for collisions (s).', low=0.001)
    simulation_time_step: float = parameter(
        0.1, 'The step in which it looks ahead (s).', low=0.001
    )
    cmd_vel_teleop: str = parameter('cmd_vel_teleop', "Where the person's velocities come from.")


class AssistedTeleop(TimedBehavior):
    """
    Assisted teleoperation: forwards the operator's velocity, scaled down near a collision.

    The last velocity is held until the next one. A message on `preempt_teleop` ends it
    successfully.
    """

    action = AssistedTeleopAction

    def configure(self) -> None:
        """Declare the parameters; subscribe to the operator's velocity and to `preempt_teleop`."""
        node = self.node
        self._look = node.parameters.declare(AssistedTeleopParameters)
        self._command, self._is_over = Velocity(), False
        is_stamped = node.told.current.enable_stamped_cmd_vel
        subscribe_twist(node, self._look.current.cmd_vel_teleop, is_stamped, self._on_command)
        node.create_subscription(Empty, 'preempt_teleop', self._on_end, 10)

    def begin(self, goal: Any) -> None:
        """
        Reset the velocity, and check that the robot's pose is available.

        Parameters
        ----------
        goal
            The goal of the action, which needs no check.

        Raises
        ------
        ActionAborted
            The robot's pose is not available.

        """
        self._command, self._is_over = Velocity(), False
        self.pose()

    def step(self, elapsed_s: float) -> bool:
        """
        Publish the operator's velocity, scaled down as far as a collision requires.

        Parameters
        ----------
        elapsed_s
            The time since the start of the goal, in s of the node's clock.

        Returns
        -------
        bool
            Whether a message on `preempt_teleop` has ended it.

        Raises
        ------
        ActionAborted
            The robot's pose is not available.

        """
        self.server.publish_feedback(
            AssistedTeleopAction.Feedback(current_teleop_duration=duration_message(elapsed_s))
        )
        if self._is_over:
            return True
        self.pose()
        self.drive(self._safe(self._command))
        return False

    def _safe(self, command: Velocity) -> Velocity:
        if command.is_zero:
            return command
        look = self._look.current
        times, poses = motion_ahead(command, look.projection_time, look.simulation_time_step)
        try:
            hit = self.node.local_checker.first_collision(poses)
        except CannotCheck as error:
            self._warn(f"'{self.name}' does not move. {error}")
            return Velocity()
        if hit is None:
            return command
        if hit == 0:
            self._warn(f"'{self.name}' stops the robot: a collision is imminent.")
            return Velocity()
        self._warn(f"'{self.name}' slows down: a collision is {times[hit]:.1f} s ahead.")
        return command.scaled(float(times[hit]) / look.projection_time)

    def _on_command(self, velocity: Velocity, _: Header | None) -> None:
        self._command = velocity

    def _on_end(self, _: Empty) -> None:
        self._is_over = True

    def _warn(self, text: str) -> None:
        self.node.get_logger().warning(text, throttle_duration_sec=1.0)
