# SPDX-License-Identifier: Apache-2.0
"""Leg odometry: the position and velocity of the base."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_control.dynamics import BodyState
from humanoid_control.dynamics.frames import Frame, Twist
from humanoid_control.walking.base_motion import BaseMotion
from humanoid_control.walking.footing import Footing
from humanoid_control.walking.pendulum import Motion
from humanoid_control.walking.planar import limited
from humanoid_control.walking.sides import SIDES
from humanoid_control.walking.walking_robot import WalkingRobot
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_SURE_LOAD = 0.2
"""A foot that carries this fraction of the weight certainly stands on the ground."""
_LEAST_TRUST = 0.02
"""Below this total the robot is airborne or falling: the commanded shares are used instead."""


@dataclass(frozen=True, eq=False)
class BaseEstimate:
    """Estimated position and velocity of the origin of the base, in the odom frame."""

    position_m: Array
    """(3,)"""
    velocity_m_s: Array
    """(3,)"""

    def motion(self, state: BodyState) -> BaseMotion:
        """
        Combine the estimated position and velocity with the measured rotation of the base.

        Parameters
        ----------
        state
            State of the robot, which holds the rotation and the angular velocity of the base.

        Returns
        -------
        BaseMotion
            Pose and twist of base_link, both in the odom frame.

        """
        return BaseMotion(
            Frame(self.position_m, state.base_rotation),
            Twist(self.velocity_m_s, state.base_angular_velocity_rad_s),
        )

    def com_motion(self, state: BodyState) -> Motion:
        """
        Compute the horizontal motion of the centre of mass.

        Parameters
        ----------
        state
            State of the robot, with the centre of mass relative to the origin of base_link.

        Returns
        -------
        Motion
            Position in m and velocity in m/s, in the plane of the odom frame.

        """
        position = self.position_m + state.com_m
        velocity = self.velocity_m_s + state.com_velocity_m_s
        return Motion(complex(position[0], position[1]), complex(velocity[0], velocity[1]))


def carrying(shares: tuple[float, float], loads: tuple[float, float]) -> tuple[float, float]:
    """
    Compute how much each foot contributes to leg odometry, from the load that it carries.

    A foot that should carry weight but does not may be off its foothold: below a fifth of the
    weight of the robot its contribution fades out.

    Parameters
    ----------
    shares
        Commanded load distribution, left and right; the sum is 1.
    loads
        Measured normal forces on the soles, as fractions of the weight of the robot.

    Returns
    -------
    tuple of float
        Weights of the left and the right foot, which sum to 1; `shares` if neither carries load.

    """
    left, right = (
        share * limited(load / _SURE_LOAD, 0.0, 1.0) for share, load in zip(shares, loads)
    )
    total = left + right
    return (left / total, right / total) if total > _LEAST_TRUST else shares


def base_on(
    footing: Footing, shares: tuple[float, float], robot: WalkingRobot, state: BodyState
) -> BaseEstimate:
    """
    Estimate the position and velocity of the base by leg odometry.

    The feet that carry weight are assumed to stand still on their footholds.

    Parameters
    ----------
    footing
        Footholds of both feet, in the odom frame.
    shares
        Weights of the left and the right foot, which sum to 1; see `carrying`.
    robot, state
        The robot and its measured state, whose points are relative to the origin of base_link.

    Returns
    -------
    BaseEstimate
        Position and velocity of the origin of base_link in the odom frame.

    """
    position, velocity = np.zeros(3), np.zeros(3)
    for side in SIDES:
        if shares[side] > 0.0:
            sole = robot.legs[side].sole
            position += shares[side] * (footing[side].sole_m - state.position_m(sole))
            velocity -= shares[side] * state.velocity_m_s(sole)
    return BaseEstimate(position, velocity)
