# SPDX-License-Identifier: Apache-2.0
"""The environment `humanoid_gym/Stand-v0`: stand while something pushes."""

from __future__ import annotations

import cmath
from collections.abc import Mapping
import math
from typing import Any

from humanoid_control.walking import VelocityCommand
from humanoid_gym.actions import JointActions
from humanoid_gym.environment import HumanoidEnv
from humanoid_gym.rewards import effort, kernel, Motion, steadiness, tracking

STRONGEST_NS = 12.0
SOONEST_S, LATEST_S = 1.0, 3.0
"""Time from a push, or from the start, to the next one."""
UPRIGHT_WIDTH_RAD = 0.2


class StandEnv(HumanoidEnv):
    """
    Stand while the pelvis is pushed every 1 to 3 s, in any direction of the ground plane.

    Parameters
    ----------
    strongest_ns
        The strongest impulse in N s; impulses are drawn from 0 to it.
    **options
        As for `HumanoidEnv`: scene, noise, render_mode, width, height.

    Raises
    ------
    SimulationError
        There is no such scene, or it has a mistake.
    ValueError
        The impulse, the render mode or the noise is not possible.

    """

    def __init__(self, strongest_ns: float = STRONGEST_NS, **options: Any) -> None:
        if not 0.0 <= strongest_ns <= 1000.0:
            raise ValueError(f'An impulse cannot be {strongest_ns} N s. Give 0 to 1000.')
        self._strongest_ns = strongest_ns
        self._next_s, self._last_ns = math.inf, 0.0
        super().__init__(JointActions, **options)

    def begin(self, options: Mapping[str, Any]) -> None:
        """
        Draw when the first push comes.

        Parameters
        ----------
        options
            There are none.

        """
        self._last_ns = 0.0
        self._next_s = float(self.np_random.uniform(SOONEST_S, LATEST_S))

    def before_period(self) -> None:
        """Push when it is time to."""
        if self.stepped.passed_s < self._next_s:
            return
        angle_rad = self.np_random.uniform(0.0, math.tau)
        self._last_ns = float(self.np_random.uniform(0.0, self._strongest_ns))
        self._next_s += float(self.np_random.uniform(SOONEST_S, LATEST_S))
        self.robot.push(cmath.rect(1.0, angle_rad), self._last_ns)

    def rewards(self, motion: Motion) -> dict[str, float]:
        """
        Reward an upright base at rest, at little effort.

        The term `upright` and its weight are our own; the others are in `rewards`.

        Parameters
        ----------
        motion
            The motion of the robot in the last step.

        """
        return {
            'upright': 1.0 * kernel(motion.tilt_rad, UPRIGHT_WIDTH_RAD),
            **tracking(motion, VelocityCommand()),
            **steadiness(motion),
            **effort(motion),
        }

    def details(self) -> dict[str, Any]:
        """Return the impulse of the last push, which the agent does not observe."""
        return {'push_ns': self._last_ns}
