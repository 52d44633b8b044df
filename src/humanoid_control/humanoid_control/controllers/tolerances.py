# SPDX-License-Identifier: Apache-2.0
"""Path and goal tolerances of joint trajectories."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
import math

from humanoid_common.naming import did_you_mean, shortened
from humanoid_control.backends import Array
from humanoid_control.controllers.commands import CommandError
import numpy as np

ERASED = -1.0
"""The value that removes a tolerance (control_msgs/JointTolerance)."""


@dataclass(frozen=True)
class JointTolerance:
    """Maximum errors of a joint: 0 is the controller's default, -1 allows any error."""

    joint: str
    position_rad: float = 0.0
    velocity_rad_s: float = 0.0


@dataclass(frozen=True, eq=False)
class StateTolerances:
    """Maximum errors of m joints, each array (m,); infinity allows any error."""

    joints: tuple[str, ...]
    position_rad: Array
    velocity_rad_s: Array

    @classmethod
    def of(
        cls,
        joints: Sequence[str],
        given: Sequence[JointTolerance],
        default_rad: float = math.inf,
    ) -> StateTolerances:
        """
        Combine the tolerances of a goal with the defaults.

        Parameters
        ----------
        joints
            The joints of the controller.
        given
            Tolerances of the goal, for any of these joints.
        default_rad
            Position tolerance of joints for which the goal has none.

        Raises
        ------
        CommandError
            A tolerance is for another joint, or has an invalid value.

        """
        position_rad = np.full(len(joints), default_rad)
        velocity_rad_s = np.full(len(joints), np.inf)
        for each in given:
            index = _index(each.joint, joints)
            position_rad[index] = _limit('position', each.joint, each.position_rad, default_rad)
            velocity_rad_s[index] = _limit('velocity', each.joint, each.velocity_rad_s, math.inf)
        return cls(tuple(joints), position_rad, velocity_rad_s)

    def violation(self, positions_rad: Array, velocities_rad_s: Array) -> str:
        """
        Describe the joint with the largest error beyond its tolerance; empty if there is none.

        Parameters
        ----------
        positions_rad, velocities_rad_s
            The errors of the joints, (m,).

        """
        for errors, limits, unit in (
            (positions_rad, self.position_rad, 'rad'),
            (velocities_rad_s, self.velocity_rad_s, 'rad/s'),
        ):
            sizes = np.abs(errors)
            beyond = sizes > limits
            if beyond.any():
                index = int(np.argmax(np.where(beyond, sizes, -1.0)))
                return (
                    f"'{self.joints[index]}' is off by {sizes[index]:.3f} {unit}, and "
                    f'{limits[index]:g} {unit} are tolerated'
                )
        return ''


def _index(joint: str, joints: Sequence[str]) -> int:
    """Look up the index of a joint; reject a joint of another controller."""
    if joint not in joints:
        raise CommandError(
            f"It has a tolerance of '{shortened(joint)}', which is no joint of this controller. "
            f'{did_you_mean(joint, joints)} It has: {", ".join(joints)}.'
        )
    return list(joints).index(joint)


def _limit(kind: str, joint: str, value: float, default: float) -> float:
    """Convert a tolerance value to the maximum error that it stands for."""
    if value == 0.0:
        return default
    if value == ERASED:
        return math.inf
    if not (math.isfinite(value) and value > 0.0):
        raise CommandError(
            f"The tolerance of the {kind} of '{joint}' is {value:g}. Give a number above zero, 0 "
            'for what the controller has by default, or -1 for none.'
        )
    return value
