# SPDX-License-Identifier: Apache-2.0
"""Poses in the plane, and their messages; metres and radians (REP-103)."""

from __future__ import annotations

from collections.abc import Iterable
import math
from typing import Any, NamedTuple

from geometry_msgs.msg import Point, Pose, PoseStamped, Quaternion
from nav_msgs.msg import Path
import numpy as np
import numpy.typing as npt
from std_msgs.msg import Header

__all__ = [
    'Pose2D',
    'angle_between',
    'make_path',
    'make_pose',
    'make_pose_stamped',
    'make_quaternion',
    'path_poses',
    'planar_pose',
    'wrap_angle',
    'yaw_of',
]

FloatArray = npt.NDArray[np.float64]


class Pose2D(NamedTuple):
    """Pose in the plane: x and y in m, yaw in rad, counter-clockwise from the x axis."""

    x: float
    y: float
    yaw: float

    def __matmul__(self, other: Pose2D) -> Pose2D:
        """Transform a pose from this frame to the parent of this frame."""
        cos, sin = math.cos(self.yaw), math.sin(self.yaw)
        return Pose2D(
            self.x + cos * other.x - sin * other.y,
            self.y + sin * other.x + cos * other.y,
            wrap_angle(self.yaw + other.yaw),
        )

    def inverse(self) -> Pose2D:
        """Invert the pose: that of the parent frame in this one."""
        cos, sin = math.cos(self.yaw), math.sin(self.yaw)
        return Pose2D(
            -cos * self.x - sin * self.y, sin * self.x - cos * self.y, wrap_angle(-self.yaw)
        )

    def distance_to(self, other: Pose2D) -> float:
        """
        Compute the distance between two positions.

        Parameters
        ----------
        other
            A pose in the same frame.

        Returns
        -------
        float
            The distance in m.

        """
        return math.hypot(other.x - self.x, other.y - self.y)


def wrap_angle(angle_rad: float) -> float:
    """
    Wrap an angle to the range from -pi, exclusive, to pi.

    Parameters
    ----------
    angle_rad
        The angle in rad.

    Returns
    -------
    float
        The same direction in rad.

    """
    return math.pi - (math.pi - angle_rad) % (2.0 * math.pi)


def angle_between(start_rad: float, end_rad: float) -> float:
    """
    Compute the shortest rotation from one angle to another.

    Parameters
    ----------
    start_rad, end_rad
        The angles in rad.

    Returns
    -------
    float
        The rotation in rad, from -pi, exclusive, to pi; positive counter-clockwise.

    """
    return wrap_angle(end_rad - start_rad)


def yaw_of(quaternion: Quaternion) -> float:
    """
    Compute the yaw of an orientation.

    Parameters
    ----------
    quaternion
        The orientation, of length 1.

    Returns
    -------
    float
        The yaw in rad, from -pi to pi.

    """
    x, y, z, w = quaternion.x, quaternion.y, quaternion.z, quaternion.w
    return math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))


def make_quaternion(yaw_rad: float) -> Quaternion:
    """
    Make the quaternion of a yaw.

    Parameters
    ----------
    yaw_rad
        The rotation about z in rad.

    """
    return Quaternion(z=math.sin(0.5 * yaw_rad), w=math.cos(0.5 * yaw_rad))


def planar_pose(pose: Pose) -> Pose2D:
    """
    Project a pose onto the plane.

    Parameters
    ----------
    pose
        The pose, whose z, roll and pitch are dropped.

    Returns
    -------
    Pose2D
        x and y in m, yaw in rad, in the same frame.

    """
    return Pose2D(pose.position.x, pose.position.y, yaw_of(pose.orientation))


def make_pose(pose: Pose2D) -> Pose:
    """
    Make the message of a pose on the ground, where z is 0.

    Parameters
    ----------
    pose
        x and y in m, yaw in rad.

    """
    message = Pose(orientation=make_quaternion(pose.yaw))
    message.position.x, message.position.y = float(pose.x), float(pose.y)
    return message


def make_pose_stamped(pose: Pose2D, frame: str, stamp: object) -> PoseStamped:
    """
    Make the stamped message of a pose on the ground.

    Parameters
    ----------
    pose
        x and y in m, yaw in rad.
    frame, stamp
        The header; the stamp is a `builtin_interfaces/Time`.

    """
    message = PoseStamped(pose=make_pose(pose))
    message.header.frame_id, message.header.stamp = frame, stamp
    return message


def make_path(poses: FloatArray | Iterable[Pose2D], frame: str, stamp: object) -> Path:
    """
    Make the message of a path.

    Parameters
    ----------
    poses
        (N, 3) array of x, y (m) and yaw (rad), or poses.
    frame, stamp
        The header of the path and of each pose.

    """
    path = Path()
    path.header.frame_id, path.header.stamp = frame, stamp
    rows = np.array([*poses], np.float64).reshape(-1, 3)
    half_yaws = 0.5 * rows[:, 2]
    places = rows[:, 0].tolist(), rows[:, 1].tolist()
    turns = np.sin(half_yaws).tolist(), np.cos(half_yaws).tolist()
    path.poses = [
        _stamped_in_plane(x, y, sine, cosine, frame, stamp)
        for x, y, sine, cosine in zip(*places, *turns)
    ]
    return path


def _stamped_in_plane(
    x: float, y: float, sine: float, cosine: float, frame: str, stamp: object
) -> PoseStamped:
    message = _bare(PoseStamped)
    header, pose = message.header, message.pose = _bare(Header), _bare(Pose)
    point, turn = pose.position, pose.orientation = _bare(Point), _bare(Quaternion)
    header.stamp, header.frame_id = stamp, frame
    point.x, point.y, point.z = x, y, 0.0
    turn.x, turn.y, turn.z, turn.w = 0.0, 0.0, sine, cosine
    return message


def _bare(kind: type) -> Any:
    """
    Make a message without fields, which do not check what they are set to.

    Constructors, which make the default of each field, take several times as long: it matters
    for whole paths.
    """
    message: Any = object.__new__(kind)
    message._check_fields = False
    return message


def path_poses(path: Path) -> FloatArray:
    """
    Convert the message of a path to an array.

    Parameters
    ----------
    path
        The path; the headers of its poses are ignored.

    Returns
    -------
    FloatArray
        (N, 3) array of x, y (m) and yaw (rad).

    """
    values = [
        (p.x, p.y, q.x, q.y, q.z, q.w)
        for p, q in ((each.pose.position, each.pose.orientation) for each in path.poses)
    ]
    px, py, x, y, z, w = np.array(values, np.float64).reshape(-1, 6).T
    yaws = np.arctan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
    return np.column_stack([px, py, yaws])
