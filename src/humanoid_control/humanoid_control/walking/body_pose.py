# SPDX-License-Identifier: Apache-2.0
"""Body pose of a standing robot: upright, or bent and lowered."""

from __future__ import annotations

from dataclasses import dataclass
import math

from humanoid_control.errors import WalkingError
from humanoid_control.walking.parameters import WalkParameters


@dataclass(frozen=True)
class BodyPose:
    """
    Body pose: pitch of the pelvis and height of the centre of mass.

    Attributes
    ----------
    pitch_rad
        Pitch of the pelvis, positive when it is bent forward.
    height_m
        Height of the centre of mass relative to an upright robot; negative is lower.

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
    """Rate limiter for the body pose, so that the balance can follow."""

    parameters: WalkParameters
    pose: BodyPose = UPRIGHT
    """Present target of the body pose."""
    pitch_rate_rad_s: float = 0.0

    @property
    def is_upright(self) -> bool:
        """Whether the body is upright enough to step."""
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
    """Move a value towards another by at most `most`."""
    return start + min(max(end - start, -most), most)
