# SPDX-License-Identifier: Apache-2.0
"""Where the centre of mass is, from what the pendulum predicts and what is measured."""

from __future__ import annotations

from dataclasses import dataclass
import math

from humanoid_control.walking.pendulum import Motion, Pendulum
from humanoid_control.walking.planar import Point


@dataclass
class ComObserver:
    """
    An observer of the linear inverted pendulum.

    It predicts exactly, over any time, with the zero-moment point that was commanded, and then
    takes over a share of the difference to the measurement that depends on the time passed.
    """

    pendulum: Pendulum
    rate_1_s: float
    motion: Motion | None = None

    def update(self, measured: Motion, zmp: Point, passed_s: float) -> Motion:
        """
        Predict the motion of the centre of mass, and correct it with the measured one.

        Parameters
        ----------
        measured
            Motion of the centre of mass by leg odometry, in the odom frame.
        zmp
            Zero-moment point (m) that was commanded since the last call, in the odom frame.
        passed_s
            Time since the last call.

        Returns
        -------
        Motion
            Estimated motion in the odom frame; the first call returns `measured`.

        """
        if self.motion is None:
            self.motion = measured
            return measured
        predicted = self.pendulum.after(self.motion, zmp, passed_s)
        self.motion = blended(predicted, measured, 1.0 - math.exp(-self.rate_1_s * passed_s))
        return self.motion


def blended(a: Motion, b: Motion, share: float) -> Motion:
    """
    Interpolate linearly between two motions of the centre of mass.

    Parameters
    ----------
    a, b
        The two motions, in the same frame.
    share
        How far to go from `a` (0) to `b` (1).

    """
    return Motion(
        a.position_m + share * (b.position_m - a.position_m),
        a.velocity_m_s + share * (b.velocity_m_s - a.velocity_m_s),
    )
