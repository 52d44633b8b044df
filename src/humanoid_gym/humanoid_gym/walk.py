# SPDX-License-Identifier: Apache-2.0
"""The environment `humanoid_gym/Walk-v0`: walk at a commanded velocity."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from humanoid_control.backends import Array, Observation
from humanoid_control.walking import VelocityCommand
from humanoid_gym.actions import Actions, JointActions, VelocityActions
from humanoid_gym.environment import HumanoidEnv
from humanoid_gym.observing import Part
from humanoid_gym.rewards import effort, Motion, steadiness, tracking
from humanoid_simulation.testing.lockstep_robot import LockstepRobot
import numpy as np

JOINTS, VELOCITY = 'joints', 'velocity'
_ACTIONS: Mapping[str, Callable[[LockstepRobot], Actions]] = {
    JOINTS: JointActions,
    VELOCITY: VelocityActions,
}
_SLOWEST, _FASTEST = (-0.2, -0.1, -0.5), (0.4, 0.1, 0.5)
"""Forward and to the left in m/s, anticlockwise in rad/s: what commands are drawn from."""
_STANDING_SHARE = 0.1


class WalkEnv(HumanoidEnv):
    """
    Walk at a commanded velocity; in a tenth of the episodes, stand.

    Parameters
    ----------
    actions
        `joints`: targets of all joints. `velocity`: a velocity for the robot's own walk, as a
        baseline, and for agents that decide where to go.
    **options
        As for `HumanoidEnv`: scene, noise, render_mode, width, height.

    Raises
    ------
    SimulationError
        There is no such scene, or it has a mistake.
    ValueError
        There are no such actions, or the render mode or the noise is not possible.

    """

    reset_options = ('velocity',)

    def __init__(self, actions: str = JOINTS, **options: Any) -> None:
        if actions not in _ACTIONS:
            raise ValueError(f"There are no actions '{actions}'. Give {' or '.join(_ACTIONS)}.")
        self._command = VelocityCommand()
        super().__init__(_ACTIONS[actions], [Part('command', 3, 1.0)], **options)

    def begin(self, options: Mapping[str, Any]) -> None:
        """
        Draw the commanded velocity.

        Parameters
        ----------
        options
            `velocity` fixes it: forward and to the left in m/s, anticlockwise in rad/s.

        """
        drawn = self.np_random.uniform(_SLOWEST, _FASTEST)
        if self.np_random.random() < _STANDING_SHARE:
            drawn = np.zeros(3)
        self._command = VelocityCommand(*map(float, options.get('velocity', drawn)))

    def task_values(self, sensed: Observation) -> dict[str, Array]:
        """
        Return the commanded velocity.

        Parameters
        ----------
        sensed
            Not used.

        """
        command = self._command
        return {
            'command': np.array([command.forward_m_s, command.left_m_s, command.turn_rad_s]),
        }

    def rewards(self, motion: Motion) -> dict[str, float]:
        """
        Reward the commanded velocity, at little effort; the terms and weights are in `rewards`.

        Parameters
        ----------
        motion
            The motion of the robot in the last step.

        """
        return {**tracking(motion, self._command), **steadiness(motion), **effort(motion)}
