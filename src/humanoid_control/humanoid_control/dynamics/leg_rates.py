# SPDX-License-Identifier: Apache-2.0
"""Differential inverse kinematics of a leg: joint velocities for a twist of its foot."""

from __future__ import annotations

import math

from humanoid_control.dynamics.frames import Frame, Twist
from humanoid_control.dynamics.leg_geometry import LegGeometry
from humanoid_control.dynamics.leg_ik import LegPosture

# Sines, cosines and distances below this are treated as zero: the leg is singular there.
SMALLEST = 1e-9
Vector = tuple[float, float, float]


def leg_rates(
    leg: LegGeometry, posture: LegPosture, sole: Frame, twist: Twist
) -> tuple[float, ...]:
    """
    Compute the joint velocities of a leg for a twist of its sole.

    It is the time derivative of `leg_posture`, in closed form: beyond reach the leg follows the
    feasible part of the motion.

    Parameters
    ----------
    leg
        Its geometry.
    posture
        The result of `leg_posture` for the same leg and sole.
    sole, twist
        Target pose of the sole, and its twist relative to the root, in the axes of the root.

    Returns
    -------
    tuple[float, ...]
        Six velocities in rad/s, in the order of the leg's joints.

    """
    hip_yaw, hip_roll, hip_pitch, knee, ankle_pitch, _ = posture.positions_rad
    wx, wy, wz = twist.angular_rad_s.tolist()
    turning = _about_z((wx, wy, wz), -hip_yaw)
    hip = _about_z(_hip_past_sole(leg, sole, twist), -hip_yaw)
    hip_in_shank = _about_y(_about_x(hip, -hip_roll), -hip_pitch - knee)
    knee_rate, pitch_rate, roll_rate = _lower_rates(leg, posture, hip_in_shank)

    # The remaining angular velocity, in the axes after the hip yaw, is that of the hip.
    c, s = math.cos(hip_roll), math.sin(hip_roll)
    axis = _about_x(_about_y((1.0, 0.0, 0.0), hip_pitch + knee + ankle_pitch), hip_roll)
    x, y, z = (a - b * roll_rate for a, b in zip(turning, axis))
    bend_rate = y / max(c, SMALLEST)
    hip_pitch_rate = bend_rate - knee_rate - pitch_rate
    return z - s * bend_rate, x, hip_pitch_rate, knee_rate, pitch_rate, roll_rate


def _hip_past_sole(leg: LegGeometry, sole: Frame, twist: Twist) -> Vector:
    """Compute the velocity of the hip relative to the moving sole, in the axes of the root."""
    vx, vy, vz = twist.linear_m_s.tolist()
    wx, wy, wz = twist.angular_rad_s.tolist()
    x, y, z = (leg.hip_m - sole.position_m).tolist()
    return (wz * y - wy * z - vx, wx * z - wz * x - vy, wy * x - wx * y - vz)


def _lower_rates(leg: LegGeometry, posture: LegPosture, velocity: Vector) -> Vector:
    """Compute the rates of knee, ankle pitch and roll for a hip velocity in shank axes."""
    _, _, _, knee, pitch, _ = posture.positions_rad
    a, b = leg.thigh_m, leg.shank_m
    sine, cosine = math.sin(knee), math.cos(knee)
    x, z = -a * sine, b + a * cosine
    vx, vy, vz = velocity
    distance = math.hypot(x, z)
    wanted = distance + posture.beyond_m
    if min(distance, wanted) < SMALLEST:
        return 0.0, 0.0, 0.0
    # Beyond reach: rotate with the direction to the hip, stretch by the reach gain `give`.
    near = distance / wanted
    away = (x * vx + z * vz) / distance
    around = (z * vx - x * vz) / distance * near
    stretch = away * posture.give
    knee_rate = 0.0 if sine < SMALLEST else -distance * stretch / (a * b * sine)
    pitch_rate = -around / distance - knee_rate * a * (a + b * cosine) / (distance * distance)
    lever = math.cos(pitch) * z + math.sin(pitch) * x
    roll_rate = 0.0 if abs(lever) < SMALLEST else near * vy / lever
    return knee_rate, pitch_rate, roll_rate


def _about_x(vector: Vector, angle: float) -> Vector:
    """Rotate a vector about x."""
    x, y, z = vector
    c, s = math.cos(angle), math.sin(angle)
    return x, c * y - s * z, s * y + c * z


def _about_y(vector: Vector, angle: float) -> Vector:
    """Rotate a vector about y."""
    x, y, z = vector
    c, s = math.cos(angle), math.sin(angle)
    return c * x + s * z, y, c * z - s * x


def _about_z(vector: Vector, angle: float) -> Vector:
    """Rotate a vector about z."""
    x, y, z = vector
    c, s = math.cos(angle), math.sin(angle)
    return c * x - s * y, s * x + c * y, z
