# SPDX-License-Identifier: Apache-2.0
"""Keyframes of the motions by which the robot gets up from the ground."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

STRETCH, ROLL_OVER, KNEEL, RISE = 'stretch', 'roll over', 'kneel', 'rise'


@dataclass(frozen=True)
class Keyframe:
    """
    Joint positions, and the time in which they are reached.

    A joint without a side counts for both: rolls and yaws then turn the other way on the right.
    Joints that are not named keep their positions.
    """

    duration_s: float
    """In the unit of time of the motions, `WalkParameters.fall.get_up_unit_s`."""
    joints_rad: Mapping[str, float]
    balances: bool = False
    """Whether the ankles keep the centre of mass above the soles, on which the robot is."""


_STRAIGHT = {
    'waist_yaw': 0.0,
    'head_yaw': 0.0,
    'head_pitch': 0.0,
    'shoulder': 0.0,
    'shoulder_yaw': 0.0,
    'elbow': 0.0,
    'hip_yaw': 0.0,
    'hip_roll': 0.0,
    'hip_pitch': 0.0,
    'knee': 0.0,
    'ankle_pitch': 0.0,
    'ankle_roll': 0.0,
}
_HANDS_FORWARD = {'shoulder': 0.0, 'shoulder_roll': 2.4, 'elbow': 0.0}
_ON_HEELS = {'hip_pitch': -0.8, 'knee': 2.3, 'ankle_pitch': 0.9}

MOTIONS: Mapping[str, tuple[Keyframe, ...]] = {
    # Arms beside the body, legs straight: what lies on its side tips onto its back or its face.
    STRETCH: (Keyframe(0.8, {**_STRAIGHT, 'shoulder_roll': 0.25}),),
    # Over the left side: the knees swing to the right, the legs are thrown to the left, the waist
    # turns the trunk after them, and the right arm and leg reach forward to the ground.
    ROLL_OVER: (
        Keyframe(
            0.54,
            {
                'waist_yaw': -0.21,
                'left_shoulder': 0.12,
                'left_shoulder_roll': 0.78,
                'left_elbow': -0.02,
                'right_shoulder': 1.08,
                'right_shoulder_roll': -2.24,
                'left_hip_yaw': 0.37,
                'left_hip_roll': 0.09,
                'left_hip_pitch': -1.74,
                'left_knee': 2.11,
                'right_hip_yaw': -0.76,
                'right_hip_roll': 0.03,
                'right_hip_pitch': -1.06,
                'right_knee': 1.56,
            },
        ),
        Keyframe(
            0.65,
            {
                'waist_yaw': 0.92,
                'left_shoulder': -1.76,
                'left_shoulder_roll': -0.03,
                'left_elbow': 0.29,
                'right_shoulder': -0.39,
                'right_shoulder_roll': -1.97,
                'left_hip_yaw': -0.3,
                'left_hip_roll': -0.22,
                'left_hip_pitch': -0.49,
                'left_knee': 1.86,
                'right_hip_yaw': -0.59,
                'right_hip_roll': -0.17,
                'right_hip_pitch': -0.55,
                'right_knee': 2.06,
            },
        ),
        Keyframe(
            0.29,
            {
                'waist_yaw': -0.82,
                'left_shoulder': -2.63,
                'left_shoulder_roll': 0.33,
                'left_elbow': -0.01,
                'right_shoulder': -1.46,
                'right_shoulder_roll': -1.79,
                'left_hip_yaw': 0.02,
                'left_hip_roll': -0.38,
                'left_hip_pitch': -1.77,
                'left_knee': 1.07,
                'right_hip_yaw': -0.38,
                'right_hip_roll': -0.19,
                'right_hip_pitch': -0.55,
                'right_knee': 1.83,
            },
        ),
        Keyframe(
            0.97,
            {
                'waist_yaw': -0.79,
                'left_shoulder': 0.52,
                'left_shoulder_roll': -0.2,
                'left_elbow': 0.69,
                'right_shoulder': 0.12,
                'right_shoulder_roll': -2.6,
                'left_hip_yaw': -0.41,
                'left_hip_roll': -0.58,
                'left_hip_pitch': -0.23,
                'left_knee': 0.18,
                'right_hip_yaw': -0.67,
                'right_hip_roll': 0.39,
                'right_hip_pitch': 0.26,
                'right_knee': 0.38,
            },
        ),
        Keyframe(
            0.4,
            {
                'right_shoulder': -1.6,
                'right_shoulder_roll': 0.0,
                'right_hip_pitch': -0.9,
                'right_knee': 0.6,
                'left_hip_yaw': 0.0,
                'left_hip_roll': 0.0,
                'left_hip_pitch': 0.0,
                'left_knee': 0.0,
            },
        ),
        Keyframe(0.6, {**_STRAIGHT, 'shoulder_roll': 0.4}),
    ),
    KNEEL: (
        # The arms come forward, above the head, by their sides.
        Keyframe(0.4, {'shoulder_roll': 1.5, 'ankle_pitch': 0.9}),
        Keyframe(0.4, {'shoulder_roll': 2.5}),
        # The knees come below the body, and the arms press it up: all fours.
        Keyframe(0.8, {**_HANDS_FORWARD, 'hip_pitch': -1.9, 'knee': 2.0}),
        Keyframe(0.5, {'shoulder': 1.3, 'shoulder_roll': 2.6}),
        Keyframe(0.6, {'shoulder': 1.9, 'knee': 2.3}),
        Keyframe(0.3, {}),
        # The hips throw the body upright, then the thighs fold onto the shanks.
        Keyframe(
            0.08,
            {
                'shoulder': 1.65,
                'shoulder_roll': 2.33,
                'elbow': 0.4,
                'hip_pitch': -0.73,
                'knee': 2.11,
                'head_pitch': 0.9,
            },
        ),
        Keyframe(
            0.11,
            {
                'shoulder': 1.69,
                'shoulder_roll': 1.78,
                'elbow': 0.6,
                'hip_pitch': -0.08,
                'knee': 2.03,
                'head_pitch': 0.55,
            },
        ),
        Keyframe(
            0.14,
            {
                'shoulder': 1.85,
                'shoulder_roll': 2.38,
                'elbow': -0.17,
                'hip_pitch': -1.18,
                'knee': 2.3,
                'head_pitch': 0.1,
            },
        ),
        Keyframe(
            0.17,
            {
                'shoulder': 1.42,
                'shoulder_roll': 2.0,
                'elbow': -0.08,
                'hip_pitch': -0.18,
                'knee': 2.14,
                'head_pitch': -0.04,
            },
        ),
        Keyframe(
            0.5,
            {'shoulder': 0.3, 'shoulder_roll': 0.4, 'elbow': 0.0, **_ON_HEELS, 'head_pitch': 0.0},
        ),
        Keyframe(0.8, {}),
    ),
    RISE: (
        # It leans back and draws its toes below itself, so that it tips onto its soles.
        Keyframe(0.3, {'hip_pitch': -0.2, 'shoulder': 0.8}),
        Keyframe(1.0, {'ankle_pitch': -1.2, 'hip_pitch': -1.15, 'shoulder': 0.0}),
        Keyframe(0.4, {}, balances=True),
        Keyframe(0.8, {'ankle_pitch': -0.8, 'knee': 1.5, 'hip_pitch': -0.7}, balances=True),
        Keyframe(
            0.8,
            {
                'hip_pitch': -0.346,
                'knee': 0.687,
                'ankle_pitch': -0.341,
                'shoulder_roll': 0.12,
                'elbow': -0.5,
            },
            balances=True,
        ),
        Keyframe(0.3, {}, balances=True),
    ),
}
