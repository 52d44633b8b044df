# SPDX-License-Identifier: Apache-2.0
"""How a robot that stands up from a squat keeps its balance on both soles."""

from __future__ import annotations

import math

from humanoid_control.backends import Array
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.pendulum import GRAVITY_M_S2
from humanoid_control.walking.planar import LEFT, RIGHT
from humanoid_control.walking.support_polygon import FootShape
from humanoid_control.walking.walking_robot import RobotState, WalkingRobot
import numpy as np

_FILTER_S = 0.04
"""Time constant of the filter of the measured velocity."""
_FADE_S = 0.3
"""Time in which the torques grow to their full size."""


class Balance:
    """
    Balance on both soles in any posture: joint torques that carry the weight and keep it there.

    The centre of pressure follows the divergent component of motion (DCM), which the centre of
    mass approaches; its motion is measured relative to the soles.

    Parameters
    ----------
    robot, shape
        The robot, and the supporting rectangle of its soles.
    parameters : WalkParameters
        Gait parameters, with the gain of the DCM feedback and the least width of the stance.

    """

    def __init__(self, robot: WalkingRobot, shape: FootShape, parameters: WalkParameters) -> None:
        self._robot, self._shape = robot, shape
        self._gain = parameters.balance.dcm_gain
        self._least_width_m = parameters.footsteps.least_width_m
        self._begin_s, self._time_s = math.inf, -math.inf
        self._offset_m, self._velocity_m_s = np.zeros(2), np.zeros(2)

    def efforts_nm(self, sensed: RobotState) -> Array:
        """
        Compute the joint torques (n,) to be added; they grow from zero at first.

        Parameters
        ----------
        sensed
            Estimated state of the robot, in consecutive control periods.

        """
        state, weight_n = sensed.state, self._robot.body.mass_kg * GRAVITY_M_S2
        soles = [state.position_m(leg.sole) for leg in self._robot.legs]
        from_soles_m = state.com_m - (soles[LEFT] + soles[RIGHT]) / 2
        self._follow(sensed.time_s, from_soles_m[:2])
        across_m = (soles[LEFT] - soles[RIGHT])[:2]
        width_m = max(self._least_width_m, float(np.linalg.norm(across_m)))
        left = across_m / width_m
        ahead = np.array([left[1], -left[0]])
        rate_1_s = math.sqrt(GRAVITY_M_S2 / max(self._least_width_m, float(from_soles_m[2])))
        wanted_m = self._shape.load_m.real * ahead
        dcm_m = self._offset_m + self._velocity_m_s / rate_1_s
        zmp_m = wanted_m + self._gain * (dcm_m - wanted_m)
        forward_m = min(self._shape.front_m, max(self._shape.back_m, float(zmp_m @ ahead)))
        share = min(1.0, max(0.0, 0.5 + float(zmp_m @ left) / width_m))
        zmp_m = forward_m * ahead + (share - 0.5) * width_m * left
        push_n = weight_n * rate_1_s**2 / GRAVITY_M_S2 * (self._offset_m - zmp_m)
        force_n = np.array([push_n[0], push_n[1], weight_n])
        efforts: Array = state.bias_nm.copy()
        for leg, sole, part in zip(self._robot.legs, soles, (share, 1.0 - share)):
            place_m = sole + forward_m * np.array([ahead[0], ahead[1], 0.0])
            efforts -= part * state.efforts_of_force_nm(leg.sole, place_m, force_n)
        return efforts * min(1.0, (sensed.time_s - self._begin_s) / _FADE_S)

    def _follow(self, time_s: float, offset_m: Array) -> None:
        """Measure how the centre of mass moves relative to the soles."""
        passed_s = time_s - self._time_s
        if passed_s < _FADE_S:
            speed_m_s = (offset_m - self._offset_m) / max(1e-3, passed_s)
            gain = -math.expm1(-passed_s / _FILTER_S)
            self._velocity_m_s = self._velocity_m_s + gain * (speed_m_s - self._velocity_m_s)
        else:
            self._begin_s, self._velocity_m_s = time_s, np.zeros(2)
        self._time_s, self._offset_m = time_s, offset_m
