# SPDX-License-Identifier: Apache-2.0
"""
Inverse kinematics of a leg, in closed form: its geometry, joint positions and velocities.

After Kajita, Hirukawa, Harada and Yokoi, Introduction to Humanoid Robotics (2014), section 2.5.2:
the distance from ankle to hip gives the knee angle, the direction to the hip in the frame of the
foot gives the ankle angles, and the remaining rotation gives the hip angles.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
import math

from humanoid_common.naming import did_you_mean
from humanoid_control.dynamics.frames import Frame, Twist
from humanoid_control.dynamics.tree import DynamicsError
from humanoid_description.drives import SIDES
from humanoid_description.errors import DescriptionError
from humanoid_description.kinematics import chain, check_limb, poses
from humanoid_description.robot import Array, Joint, Robot
import numpy as np

# The joints from the hip to the foot, and their axes of rotation.
AXES = {
    'hip_yaw': 'z',
    'hip_roll': 'x',
    'hip_pitch': 'y',
    'knee': 'y',
    'ankle_pitch': 'y',
    'ankle_roll': 'x',
}
_SOLES = dict(zip(SIDES, ('l_sole', 'r_sole')))
_TOLERANCE = 1e-9

# The last fraction of the leg length, in which the leg smoothly stops following the foot.
SOFT = 0.002

# Sines, cosines and distances below this are treated as zero: the leg is singular there.
SMALLEST = 1e-9
Vector = tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class LegGeometry:
    """
    Geometry of a leg that hangs straight down at zero joint positions.

    The three axes of the hip intersect in one point, the two of the ankle in another; the knee is
    between them. At zero the axes of the sole are parallel to those of the root.
    """

    joints: tuple[str, ...]
    """six names: hip yaw, roll, pitch, knee, ankle pitch, roll"""
    sole: str
    """the link of the sole"""
    hip_m: Array
    """(3,) in the root"""
    thigh_m: float
    shank_m: float
    ankle_m: Array
    """(3,) in the sole"""

    @classmethod
    def of(cls, robot: Robot, side: str) -> LegGeometry:
        """
        Read the geometry of a leg from the description of a robot.

        Parameters
        ----------
        robot
            Its links and joints.
        side
            `left` or `right`.

        Raises
        ------
        DynamicsError
            The side is unknown, or the robot has no such leg, or its kinematics are different.

        """
        sole = _sole(robot, side)
        joints = [joint for joint in chain(robot, sole) if joint.is_driven]
        at_zero = poses(robot)
        _check(robot, side, joints, [at_zero[joint.child] for joint in joints])
        hip, knee, ankle = (at_zero[joints[i].child][:3, 3] for i in (2, 3, 5))
        return cls(
            tuple(joint.name for joint in joints),
            sole,
            hip,
            float(hip[2] - knee[2]),
            float(knee[2] - ankle[2]),
            ankle - at_zero[sole][:3, 3],
        )

    @property
    def length_m(self) -> float:
        """Return the distance from hip to ankle of the stretched leg."""
        return self.thigh_m + self.shank_m


def _sole(robot: Robot, side: str) -> str:
    """Return the name of the sole link of a leg."""
    if side not in _SOLES:
        raise DynamicsError(f"A side must be {' or '.join(SIDES)}, not '{side}'.")
    sole = robot.prefix + _SOLES[side]
    if sole not in robot.link:
        raise DynamicsError(
            f"Robot '{robot.name}' has no {side} leg: there is no link '{sole}'. "
            f'{did_you_mean(sole, robot.link)}'.rstrip()
        )
    return sole


def _check(robot: Robot, side: str, joints: Sequence[Joint], at_zero: Sequence[Array]) -> None:
    """Validate the joints and axes of a leg; poses are at zero joint positions, in the root."""
    axes = {f'{robot.prefix}{side}_{kind}': axis for kind, axis in AXES.items()}
    try:
        check_limb(f'{side} leg', joints, at_zero, axes)
    except DescriptionError as error:
        raise DynamicsError(str(error)) from error
    _check_places([pose[:3, 3] for pose in at_zero], side)


def _check_places(points: Sequence[Array], side: str) -> None:
    """Reject a leg whose joint axes do not meet as the closed-form solution requires."""
    yaw, roll, hip, knee, pitch, ankle = points
    straight = all(
        np.allclose(lower[:2], upper[:2], atol=_TOLERANCE) and lower[2] < upper[2]
        for upper, lower in ((hip, knee), (knee, ankle))
    )
    meet = all(
        np.allclose(one, other, atol=_TOLERANCE)
        for one, other in ((yaw, hip), (roll, hip), (pitch, ankle))
    )
    if not (straight and meet):
        raise DynamicsError(
            f'The kinematics of the {side} leg are not supported: the three hip axes must '
            'intersect in one point, the two ankle axes in another, with the knee straight '
            'between them.'
        )


@dataclass(frozen=True)
class LegPosture:
    """Joint positions of a leg for a pose of its sole, and how far that is out of reach."""

    positions_rad: tuple[float, ...]
    """six, in the order of the leg's joints"""
    beyond_m: float
    """distance by which the ankle falls short of its target, away from the hip; 0 within reach,
    negative if the target is nearer to the hip than the leg can fold"""
    give: float
    """reach gain: the fraction of a motion away from the hip that the leg follows; 1 within
    reach"""


def leg_posture(leg: LegGeometry, sole: Frame) -> LegPosture:
    """
    Compute the inverse kinematics of a leg for a pose of its sole.

    Beyond reach the leg stretches towards the target of the ankle, and the sole keeps its target
    orientation. The transition is smooth: see `SOFT`.

    Parameters
    ----------
    leg
        Its geometry.
    sole
        Target pose of the sole, in the frame of the root.

    Returns
    -------
    LegPosture
        The six joint positions, and how far the target is beyond reach.

    Raises
    ------
    DynamicsError
        The pose is not finite.

    """
    (r00, r01, r02), (r10, r11, r12), (r20, r21, r22) = sole.rotation.tolist()
    px, py, pz = sole.position_m.tolist()
    ax, ay, az = leg.ankle_m.tolist()
    hx, hy, hz = leg.hip_m.tolist()
    # From the ankle to the hip: in the axes of the root, then in those of the sole.
    x, y, z = hx - px, hy - py, hz - pz
    x, y, z = (
        r00 * x + r10 * y + r20 * z - ax,
        r01 * x + r11 * y + r21 * z - ay,
        r02 * x + r12 * y + r22 * z - az,
    )
    wanted_m = math.sqrt(x * x + y * y + z * z)
    if not math.isfinite(wanted_m):
        raise DynamicsError(
            f'The target of the sole is {sole.position_m}, turned by {sole.rotation.tolist()}: '
            'give finite numbers.'
        )
    distance_m, give = _reached(leg, wanted_m)
    knee = _knee(leg, distance_m)
    roll, pitch = _ankle(leg, (x, y, z), knee)

    # The rotation of the thigh is that of the sole without those of ankle and knee.
    c, s = math.cos(roll), math.sin(roll)
    ct, st = math.cos(pitch + knee), math.sin(pitch + knee)
    up = s * r21 + c * r22
    y0, y1, y2 = c * r01 - s * r02, c * r11 - s * r12, c * r21 - s * r22
    hip_yaw = math.atan2(-y0, y1)
    hip_roll = math.atan2(y2, math.hypot(y0, y1))
    hip_pitch = math.atan2(-ct * r20 - st * up, ct * up - st * r20)
    return LegPosture(
        (hip_yaw, hip_roll, hip_pitch, knee, pitch, roll), wanted_m - distance_m, give
    )


def _reached(leg: LegGeometry, wanted_m: float) -> tuple[float, float]:
    """Limit the distance from ankle to hip to the reach of the leg; also return the reach gain."""
    soft_m = SOFT * leg.length_m
    free_m = leg.length_m - soft_m
    shortest_m = abs(leg.thigh_m - leg.shank_m)
    if wanted_m > free_m:
        give = math.exp((free_m - wanted_m) / soft_m)
        return leg.length_m - soft_m * give, give
    if wanted_m < shortest_m:
        return shortest_m, 0.0
    return wanted_m, 1.0


def _knee(leg: LegGeometry, distance_m: float) -> float:
    """Compute the knee angle for a distance from ankle to hip."""
    a, b = leg.thigh_m, leg.shank_m
    # With half angles: accurate for a leg that is nearly stretched, where the arc cosine is not.
    shorter = max(0.0, (a + b - distance_m) * (a + b + distance_m))
    longer = max(0.0, (distance_m - a + b) * (distance_m + a - b))
    return 2.0 * math.atan2(math.sqrt(shorter), math.sqrt(longer))


def _ankle(leg: LegGeometry, hip_m: Vector, knee: float) -> tuple[float, float]:
    """Compute the ankle roll and pitch for a position of the hip in the axes of the sole."""
    x, y, z = hip_m
    if z < 0.0:  # an upside-down foot rolls by less than a quarter turn, too
        roll, height = math.atan2(-y, -z), -math.hypot(y, z)
    else:
        roll, height = math.atan2(y, z), math.hypot(y, z)
    back = leg.thigh_m * math.sin(knee)
    up = leg.shank_m + leg.thigh_m * math.cos(knee)
    pitch = -math.atan2(x, height) - math.atan2(back, up)
    return roll, math.remainder(pitch, 2.0 * math.pi)


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
