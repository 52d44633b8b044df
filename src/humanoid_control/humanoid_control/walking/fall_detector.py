# SPDX-License-Identifier: Apache-2.0
"""Fall detection by the tilt and the height of the base."""

from __future__ import annotations

from dataclasses import dataclass
import math

from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.sides import SIDES
from humanoid_control.walking.state_estimator import RobotState
from humanoid_control.walking.walking_robot import WalkingRobot


@dataclass(frozen=True)
class Stance:
    """Stance of the robot: tilt and height of the base, and the load on the soles."""

    tilt_rad: float
    """Angle between the z axis of the base and the vertical."""
    tilting_rad_s: float
    """Rate of the tilt; negative while the robot rights itself."""
    height_m: float
    """Height of the base above the lower one of the soles."""
    load: float
    """Normal force on the soles, as a fraction of the weight."""

    @classmethod
    def of(cls, robot: WalkingRobot, sensed: RobotState) -> Stance:
        """
        Compute the stance from the estimated state of the robot.

        Parameters
        ----------
        robot
            The robot, with the sole links of its legs.
        sensed
            Estimated state of the robot.

        """
        _, _, z = sensed.state.base_rotation.T.tolist()
        sine = math.hypot(z[0], z[1])
        rates = sensed.state.base_angular_velocity_rad_s.tolist()
        # The tip of the z axis moves with the cross product of the rates and the axis.
        outwards = rates[1] * z[0] - rates[0] * z[1]
        soles = (sensed.state.position_m(robot.legs[side].sole)[2] for side in SIDES)
        return cls(
            math.atan2(sine, z[2]),
            outwards / sine if sine > 0.0 else math.hypot(rates[0], rates[1]),
            -float(min(soles)),
            sum(sensed.loads),
        )


@dataclass(frozen=True)
class FallDetector:
    """Fall detector by thresholds of the tilt and the height of the base."""

    parameters: WalkParameters
    standing_height_m: float

    def is_falling(self, stance: Stance) -> bool:
        """
        Check whether the robot is falling: it leans too far, soon will, or its base is too low.

        The tilt rate of an upright robot is ignored, since the landing of a foot jerks it.

        Parameters
        ----------
        stance
            Tilt and height of the base.

        """
        p = self.parameters
        foresight_s = p.fall.foresight_s if stance.tilt_rad > p.fall.upright_tilt_rad else 0.0
        soon_rad = stance.tilt_rad + foresight_s * max(0.0, stance.tilting_rad_s)
        return (
            soon_rad > p.fall.tilt_rad or stance.height_m < p.fall.height * self.standing_height_m
        )

    def can_stand(self, stance: Stance) -> bool:
        """
        Check whether the base is upright and high enough above the soles to stand up from there.

        Parameters
        ----------
        stance
            Tilt and height of the base.

        """
        p = self.parameters
        return (
            stance.tilt_rad < p.fall.upright_tilt_rad
            and stance.height_m > p.fall.height * self.standing_height_m
        )
