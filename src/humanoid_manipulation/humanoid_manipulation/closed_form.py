# SPDX-License-Identifier: Apache-2.0
"""
Closed-form inverse kinematics of an arm with six joints: up to eight postures for a pose.

The three axes of the shoulder intersect in one point, so the arm has a closed-form solution by
D. L. Pieper, The Kinematics of Manipulators under Computer Control (1968): the distance from wrist
to shoulder gives the elbow angle, the direction to the shoulder in the frame of the hand gives the
wrist angles, and the remaining rotation gives the shoulder angles. Each of the three steps has two
solutions.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
import math

Posture = tuple[float, ...]
"""The positions of the six joints of an arm (rad), from the shoulder down."""
Vector = tuple[float, float, float]

_TOLERANCE = 1e-9
_STRETCHED_M = 1e-7
"""A shoulder within this distance of the forearm's line counts as on it: see `near`."""
_COINCIDING = 1e-9
"""Cosine of the roll below which pitch and yaw share one axis: a singularity."""
_FREE = (0.0,) * 6


def solutions(
    upper_m: float,
    fore_m: float,
    to_shoulder_m: Vector,
    rotation: Sequence[Sequence[float]],
    near: Sequence[float] | None = None,
) -> Iterator[Posture]:
    """
    Yield all solutions of the inverse kinematics of an arm, ignoring the joint limits.

    Parameters
    ----------
    upper_m, fore_m
        The lengths from shoulder to elbow and from there to the wrist.
    to_shoulder_m
        The vector from the wrist to the shoulder, in the axes of the hand.
    rotation
        The rotation matrix of the hand in the base of the arm, row by row.
    near
        The posture that supplies the free joint at a singularity; zero by default.

    """
    wx, wy, wz = to_shoulder_m
    given = near or _FREE
    for elbow in _elbows(upper_m, fore_m, math.sqrt(wx * wx + wy * wy + wz * wz)):
        back, up = -upper_m * math.sin(elbow), fore_m + upper_m * math.cos(elbow)
        for wrist_yaw in _wrist_yaws(back, wy, given[4]):
            ahead = back * math.cos(wrist_yaw)
            wrist_pitch = math.atan2(wz, wx) - math.atan2(up, ahead)
            below = elbow, wrist_yaw, wrist_pitch
            for pitch, roll, yaw in _shoulders(rotation, below, given[0]):
                yield (
                    pitch,
                    roll,
                    math.remainder(yaw, math.tau),
                    elbow,
                    math.remainder(wrist_yaw, math.tau),
                    math.remainder(wrist_pitch, math.tau),
                )


def lack_m(upper_m: float, fore_m: float, to_shoulder_m: Vector) -> float:
    """
    Compute by how far a pose misses the workspace of an arm, ignoring the joint limits.

    Parameters
    ----------
    upper_m, fore_m, to_shoulder_m
        As for `solutions`.

    Returns
    -------
    float
        By how much the wrist is too far from the shoulder or too near to it, or the shoulder is
        too far off the plane in which the hand bends, in m; 0 if a solution exists.

    """
    wx, wy, wz = to_shoulder_m
    distance_m = math.sqrt(wx * wx + wy * wy + wz * wz)
    nearest_m = min(max(distance_m, abs(upper_m - fore_m)), upper_m + fore_m)
    (elbow, *_) = _elbows(upper_m, fore_m, nearest_m)
    beside_m = max(abs(wy) - abs(upper_m * math.sin(elbow)), 0.0)
    return abs(distance_m - nearest_m) + beside_m


def _elbows(upper_m: float, fore_m: float, distance_m: float) -> tuple[float, ...]:
    """Return the elbow angles that bring wrist and shoulder to a distance."""
    # Half angles: accurate for a nearly stretched arm, where the cosine is not.
    shorter = (upper_m + fore_m - distance_m) * (upper_m + fore_m + distance_m)
    longer = (distance_m - upper_m + fore_m) * (distance_m + upper_m - fore_m)
    if not min(shorter, longer) >= -_TOLERANCE:
        return ()
    turn = 2.0 * math.atan2(math.sqrt(max(shorter, 0.0)), math.sqrt(max(longer, 0.0)))
    return (turn, -turn) if turn else (turn,)


def _wrist_yaws(back: float, across: float, given: float) -> tuple[float, ...]:
    """Return the wrist yaw angles that give the shoulder's offset across the hand."""
    if abs(across) > abs(back) + _STRETCHED_M:
        return ()
    if abs(back) <= _STRETCHED_M:
        return (given,)
    turn = math.asin(max(-1.0, min(1.0, -across / back)))
    return turn, math.pi - turn


def _shoulders(
    rotation: Sequence[Sequence[float]], below: Vector, given: float
) -> Iterator[Vector]:
    """Yield the pitch, roll and yaw of the shoulder that give the hand its rotation."""
    (r00, r01, r02), (r10, r11, r12), (r20, r21, r22) = rotation
    elbow, wrist_yaw, wrist_pitch = below
    # The rotation of the upper arm is that of the hand, with the joints below undone.
    c6, s6 = math.cos(wrist_pitch), math.sin(wrist_pitch)
    c5, s5 = math.cos(wrist_yaw), math.sin(wrist_yaw)
    c4, s4 = math.cos(elbow), math.sin(elbow)
    # Its columns: those of Ry(-wrist_pitch) Rz(-wrist_yaw) Ry(-elbow).
    m00, m01, m02 = c6 * c5 * c4 - s6 * s4, c6 * s5, -c6 * c5 * s4 - s6 * c4
    m10, m11, m12 = -s5 * c4, c5, s5 * s4
    m20, m21, m22 = s6 * c5 * c4 + c6 * s4, s6 * s5, -s6 * c5 * s4 + c6 * c4
    u02 = r00 * m02 + r01 * m12 + r02 * m22
    u10 = r10 * m00 + r11 * m10 + r12 * m20
    u11 = r10 * m01 + r11 * m11 + r12 * m21
    u12 = r10 * m02 + r11 * m12 + r12 * m22
    u22 = r20 * m02 + r21 * m12 + r22 * m22
    level = math.hypot(u02, u22)
    for cosine_roll in (level, -level):
        roll = math.atan2(-u12, cosine_roll)
        if level > _COINCIDING:
            pitch = math.atan2(u02 / cosine_roll, u22 / cosine_roll)
            yaw = math.atan2(u10 / cosine_roll, u11 / cosine_roll)
        else:
            u00 = r00 * m00 + r01 * m10 + r02 * m20
            u01 = r00 * m01 + r01 * m11 + r02 * m21
            pitch = given
            yaw = math.copysign(1.0, -u12) * pitch + math.atan2(-u01, u00)
        yield pitch, roll, yaw
