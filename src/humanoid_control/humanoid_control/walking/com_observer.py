# SPDX-License-Identifier: Apache-2.0
"""Observer of the centre of mass, with a pendulum model and leg odometry."""

from __future__ import annotations

from dataclasses import dataclass
import math

from humanoid_control.walking.pendulum import Motion, Pendulum
from humanoid_control.walking.planar import Point


@dataclass
class ComObserver:
    """
    Observer of the centre of mass with a linear inverted pendulum model.

    It predicts with the commanded zero-moment point, exactly over any time, and then corrects a
    fraction of the difference from the measurement that depends on the time passed.
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
        Interpolation factor, from `a` (0) to `b` (1).

    """
    return Motion(
        a.position_m + share * (b.position_m - a.position_m),
        a.velocity_m_s + share * (b.velocity_m_s - a.velocity_m_s),
    )
