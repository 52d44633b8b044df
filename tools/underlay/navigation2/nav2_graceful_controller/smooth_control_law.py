# SPDX-License-Identifier: Apache-2.0
"""
Smooth control law for driving to a pose.

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
    """Smooth control law with its gains and limits."""

    k_phi: float
    """k1 of the paper: how fast the heading converges to the line of the target."""
    k_delta: float
    """k2 of the paper: how fast the heading error converges to zero."""
    beta: float
    lambda_: float
    """Beta and lambda of the paper: how much curvature reduces the speed."""
    v_min: float
    """m/s"""
    v_max: float
    w_max: float
    """rad/s"""

    def velocity(self, target: Pose2D, *, backward: bool = False) -> tuple[float, float]:
        """
        Compute the velocity along x in m/s, and the angular velocity in rad/s.

        Parameters
        ----------
        target
            The target pose in the base frame.
        backward
            Whether to drive there backward.

        """
        if backward:
            # In the reversed frame, the robot drives forward.
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
        Simulate the poses on the way to a target.

        Parameters
        ----------
        target
            The target pose in the base frame.
        step_m
            The spacing of the poses.
        tolerance_m
            The distance to the target at which the simulation ends.
        backward
            Whether to drive backward.

        Returns
        -------
        (N, 3) poses in the base frame; the last one is far from the target if the law does not
        converge.

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
