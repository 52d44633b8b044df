# SPDX-License-Identifier: Apache-2.0
"""
A control law that leads smoothly to a pose.

Source: J. J. Park, B. Kuipers, A Smooth Control Law for Graceful Motion of Differential Wheeled
Mobile Robots in 2D Environment, ICRA 2011.
"""

from __future__ import annotations

from dataclasses import dataclass
import math

from nav2_util.geometry import Pose2D, wrap_angle
import numpy as np
import numpy.typing as npt

__all__ = ['SmoothControlLaw']

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True)
class SmoothControlLaw:
    """The gains of the law, and its limits."""

    k_phi: float
    """k1 of the paper: how fast the heading turns to the target's line."""
    k_delta: float
    """k2 of the paper: how fast the error of the heading vanishes."""
    beta: float
    lambda_: float
    """Both: how much curvature slows down."""
    v_min: float
    """m/s"""
    v_max: float
    w_max: float
    """rad/s"""

    def velocity(self, target: Pose2D, *, backward: bool = False) -> tuple[float, float]:
        """
        Return the velocity along x in m/s, and the angular velocity in rad/s.

        Parameters
        ----------
        target
            Where to go, in the base frame.
        backward
            Whether to drive there backward.

        """
        if backward:
            # Seen from behind, the robot drives forward.
            v, w = self.velocity(Pose2D(-target.x, -target.y, target.yaw))
            return -v, w
        r = math.hypot(target.x, target.y)
        if r < 1e-6:
            return 0.0, 0.0
        delta = math.atan2(-target.y, target.x)
        phi = wrap_angle(target.yaw + delta)
        term = delta - math.atan(-self.k_phi * phi)
        slope = 1.0 + self.k_phi / (1.0 + (self.k_phi * phi) ** 2)
        curvature = -(self.k_delta * term + slope * math.sin(delta)) / r
        v = self.v_max / (1.0 + self.beta * abs(curvature) ** self.lambda_)
        v = min(max(v, self.v_min), self.v_max)
        w = min(max(curvature * v, -self.w_max), self.w_max)
        if abs(curvature) > 1e-6 and abs(w) < abs(curvature * v):
            v = w / curvature
        return v, w

    def simulate(
        self, target: Pose2D, step_m: float, tolerance_m: float, *, backward: bool = False
    ) -> FloatArray:
        """
        Return the poses on the way to a target.

        Parameters
        ----------
        target
            Where to go, in the base frame.
        step_m
            The distance of the poses.
        tolerance_m
            How near to the target the way ends.
        backward
            Whether to drive backward.

        Returns
        -------
        (N, 3) poses in the base frame; the last one is far from the target if the law does not
        lead there.

        """
        pose = Pose2D(0.0, 0.0, 0.0)
        poses: list[Pose2D] = [pose]
        limit = math.ceil(3.0 * math.hypot(target.x, target.y) / step_m) + 2
        for _ in range(limit):
            here = pose.inverse() @ target
            if math.hypot(here.x, here.y) <= tolerance_m:
                break
            v, w = self.velocity(here, backward=backward)
            dt = min(step_m / max(abs(v), 1e-3), 0.3 / max(abs(w), 1e-3))
            pose = pose @ Pose2D(v * dt, 0.0, w * dt)
            poses.append(pose)
        return np.array(poses)
