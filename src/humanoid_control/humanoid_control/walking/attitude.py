# SPDX-License-Identifier: Apache-2.0
"""Attitude control of the pelvis by the hip torques of the stance legs."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_control.dynamics.rotations import wrap_angle
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.turning import Turning
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Attitude:
    """Attitude of the pelvis, and its angular velocity in its own axes."""

    roll_rad: float
    pitch_rad: float
    yaw_rad: float
    rates_rad_s: tuple[float, float, float]


def hip_efforts(
    parameters: WalkParameters,
    attitude: Attitude,
    turning: Turning,
    pitch_rad: float = 0.0,
    pitch_rate_rad_s: float = 0.0,
) -> Array:
    """
    Compute the hip torques that hold the pelvis upright and on its heading.

    A PD law on the attitude for a leg that carries the whole weight: scale the torques by the
    share of the load on each leg.

    Parameters
    ----------
    parameters : WalkParameters
        Stiffness and damping of the attitude, and the fraction of both that acts on the heading.
    attitude
        Measured attitude of base_link in the odom frame, and rates in its own axes.
    turning
        Wanted heading of the pelvis in the odom frame, and its rate.
    pitch_rad, pitch_rate_rad_s
        Wanted pitch of the pelvis, positive when it is bent forward, and its rate.

    Returns
    -------
    Array
        Torques (3,) of hip yaw, roll and pitch in N m.

    """
    stiffness, damping = (
        parameters.balance.attitude_stiffness_nm_rad,
        parameters.balance.attitude_damping_nms_rad,
    )
    roll, pitch, yaw = attitude.rates_rad_s
    off_course_rad = wrap_angle(attitude.yaw_rad - turning.heading_rad)
    return np.array(
        [
            parameters.balance.heading_share
            * (stiffness * off_course_rad + damping * (yaw - turning.rate_rad_s)),
            stiffness * attitude.roll_rad + damping * roll,
            stiffness * (attitude.pitch_rad - pitch_rad) + damping * (pitch - pitch_rate_rad_s),
        ]
    )
