# SPDX-License-Identifier: Apache-2.0
"""How a robot that stands holds its pelvis: upright, or bent forward and lower."""

from __future__ import annotations

from dataclasses import dataclass
import math

from humanoid_control.walking.errors import WalkingError
from humanoid_control.walking.parameters import WalkParameters


@dataclass(frozen=True)
class BodyPose:
    """
    How the pelvis is held.

    Attributes
    ----------
    pitch_rad
        How far it is bent forward.
    height_m
        How high the centre of mass is, compared to a robot that stands upright; negative is lower.

    """

    pitch_rad: float = 0.0
    height_m: float = 0.0

    def within(self, parameters: WalkParameters) -> BodyPose:
        """
        Clamp the pose to the range that the robot can reach.

        Parameters
        ----------
        parameters : WalkParameters
            Limits of the pitch (`bend_rad`, `bend_back_rad`) and of the height (`lower_m`).

        Raises
        ------
        WalkingError
            The pose is not finite.

        """
        if not (math.isfinite(self.pitch_rad) and math.isfinite(self.height_m)):
            raise WalkingError(
                f'The body cannot be pitched by {self.pitch_rad:g} rad at a height of '
                f'{self.height_m:g} m: give finite numbers.'
            )
        return BodyPose(
            min(
                max(self.pitch_rad, -parameters.body_pose.bend_back_rad),
                parameters.body_pose.bend_rad,
            ),
            min(max(self.height_m, -parameters.body_pose.lower_m), 0.0),
        )


UPRIGHT = BodyPose()


@dataclass
class BodyPoseFollower:
    """Goes from one pose of the body to another, at a rate that the balance can follow."""

    parameters: WalkParameters
    pose: BodyPose = UPRIGHT
    """How the pelvis is to be held now."""
    pitch_rate_rad_s: float = 0.0

    @property
    def is_upright(self) -> bool:
        """Whether the robot may step."""
        p = self.parameters
        return (
            abs(self.pose.pitch_rad) < p.body_pose.upright_pitch_rad
            and self.pose.height_m > -p.body_pose.upright_height_m
        )

    def update(self, wanted: BodyPose, passed_s: float) -> None:
        """
        Move the body pose towards a wanted one at limited rates. Call once per control period.

        Parameters
        ----------
        wanted
            Pose to reach, within the limits (see `BodyPose.within`).
        passed_s
            Time since the last call.

        """
        p = self.parameters
        pitch_rad = _towards(
            self.pose.pitch_rad, wanted.pitch_rad, p.body_pose.bend_rad_s * passed_s
        )
        height_m = _towards(self.pose.height_m, wanted.height_m, p.body_pose.lower_m_s * passed_s)
        turned_rad = pitch_rad - self.pose.pitch_rad
        self.pitch_rate_rad_s = turned_rad / passed_s if passed_s > 0.0 else 0.0
        self.pose = BodyPose(pitch_rad, height_m)


def _towards(start: float, end: float, most: float) -> float:
    """Return what is on the way from one number to another, at most so far."""
    return start + min(max(end - start, -most), most)
