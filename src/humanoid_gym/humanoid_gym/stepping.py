# SPDX-License-Identifier: Apache-2.0
"""A robot in lockstep with its world that obeys one action for some control periods."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import gymnasium
from humanoid_control.backends import Array, Observation
from humanoid_gym.actions import Actions
from humanoid_gym.rewards import Motion
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.testing.lockstep_robot import LockstepRobot
import numpy as np

PERIODS = 2
"""Control periods of a step, each with the same action."""


class SteppedRobot:
    """
    A robot whose time advances by steps, from a reset on.

    Parameters
    ----------
    robot
        The robot and its world, before its first step.
    actions
        How actions move it.

    Attributes
    ----------
    last_action
        The action of the last step; zero after a reset.

    """

    def __init__(self, robot: LockstepRobot, actions: Actions) -> None:
        self._robot, self._actions = robot, actions
        robot.stands  # noqa: B018  the first access, while it stands, sets the height
        self.reset()

    @property
    def step_s(self) -> float:
        """Return the simulated time of a step."""
        return PERIODS * self._robot.backend.period_s

    @property
    def passed_s(self) -> float:
        """Return the simulated time since the reset."""
        return self._periods * self._robot.backend.period_s

    @property
    def sensed(self) -> Observation:
        """Return the present measurements without noise, with the time since the reset."""
        # With the time of the world, an episode would depend on those before by rounding.
        return replace(self._robot.backend.observe()[''], time_s=self.passed_s)

    def reset(self) -> None:
        """Put the robot back into its home posture, at rest."""
        self._robot.reset()
        self._periods = 0
        self.last_action = np.zeros(self._actions.size)
        self._actions.take(self.last_action)

    def step(self, action: Array, before_period: Callable[[], None]) -> Motion:
        """
        Obey an action for a step, or until the robot falls.

        Parameters
        ----------
        action
            Its values, from -1 to 1.
        before_period
            Called before each control period.

        """
        before = self.sensed
        self._actions.take(action)
        has_fallen = not self._advance(before_period)
        after = self.sensed
        change_rad_s = after.velocities_rad_s - before.velocities_rad_s
        motion = Motion(
            base=self._robot.truth,
            yaw_rad=self._robot.pose.yaw_rad,
            tilt_rad=self._robot.tilt_rad,
            sensed=after,
            accelerations_rad_s2=change_rad_s / self.step_s,
            action_change=action - self.last_action,
            has_fallen=has_fallen,
        )
        self.last_action = action
        return motion

    def _advance(self, before_period: Callable[[], None]) -> bool:
        """Advance by a step; return whether the robot is still on its feet."""
        for _ in range(PERIODS):
            before_period()
            targets = self._actions.targets(self.sensed)
            try:
                self._robot.backend.step({'': targets})
            except SimulationError as error:  # the physics has diverged, and is as it was before
                gymnasium.logger.warn(f'The episode ends. {error}')
                return False
            self._periods += 1
            if not self._robot.stands or self._robot.walking.walker.has_fallen:
                return False
        return True
