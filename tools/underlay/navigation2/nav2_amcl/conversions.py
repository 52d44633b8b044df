# SPDX-License-Identifier: Apache-2.0
"""Convert ROS messages to the types of AMCL's core and back."""

from __future__ import annotations

import struct
from typing import Any

from geometry_msgs.msg import PoseWithCovarianceStamped, TransformStamped
from nav2_amcl.clusters import Cluster
from nav2_amcl.occupancy_map import FloatArray, OccupancyMap
from nav2_amcl.scan_projection import Scan
from nav2_util.geometry import make_pose, make_quaternion, Pose2D, yaw_of
import numpy as np

__all__ = [
    'cloud_bytes',
    'covariance_of',
    'map_of',
    'pose_message',
    'rotation_and_translation',
    'scan_of',
    'transform_message',
]

_PLANE = np.array([0, 1, 5])
"""The indices of x, y and yaw in the 6 x 6 covariance of a pose."""


def map_of(message: Any) -> OccupancyMap:
    """
    Convert a `nav_msgs/OccupancyGrid` to a map.

    Parameters
    ----------
    message
        The grid; its origin may be rotated.

    Raises
    ------
    ValueError
        It has no cells, or not as many as its size states; the text is the end of a sentence.

    """
    info = message.info
    if not info.width or not info.height or info.resolution <= 0.0:
        raise ValueError('it has no cells')
    if len(message.data) != info.width * info.height:
        raise ValueError(
            f'it has {len(message.data)} cells instead of {info.width} x {info.height}'
        )
    cells = np.frombuffer(message.data, np.int8).reshape(info.height, info.width)
    corner = info.origin
    origin = corner.position.x, corner.position.y, yaw_of(corner.orientation)
    return OccupancyMap(cells, info.resolution, origin)


def scan_of(message: Any) -> Scan:
    """
    Convert a `sensor_msgs/LaserScan` to the readings of a scan.

    Parameters
    ----------
    message
        The scan; its ranges are not copied.

    """
    return Scan(
        np.frombuffer(message.ranges, np.float32),
        message.angle_min,
        message.angle_increment,
        message.range_min,
        message.range_max,
    )


def covariance_of(message: PoseWithCovarianceStamped) -> FloatArray:
    """
    Extract the covariance of a pose in the plane.

    Parameters
    ----------
    message
        A pose with the 6 x 6 covariance of x, y, z, roll, pitch and yaw.

    Returns
    -------
    numpy.ndarray
        Covariance (3, 3) of x, y (m) and yaw (rad).

    """
    whole = np.asarray(message.pose.covariance, float).reshape(6, 6)
    found: FloatArray = whole[np.ix_(_PLANE, _PLANE)]
    return found


def pose_message(estimate: Cluster, frame: str, stamp: Any) -> PoseWithCovarianceStamped:
    """
    Convert an estimated pose and its covariance to a message.

    Parameters
    ----------
    estimate
        The cluster of particles whose mean is the pose.
    frame, stamp
        The header: the frame of the map, and the time of the scan.

    """
    message = PoseWithCovarianceStamped()
    message.header.frame_id, message.header.stamp = frame, stamp
    message.pose.pose = make_pose(Pose2D(*estimate.pose))
    whole = np.zeros((6, 6))
    whole[np.ix_(_PLANE, _PLANE)] = estimate.covariance
    message.pose.covariance = whole.ravel()
    return message


def rotation_and_translation(transform: TransformStamped) -> tuple[FloatArray, FloatArray]:
    """
    Convert a transform to a rotation matrix and a vector.

    Parameters
    ----------
    transform
        As tf2 returns it; its quaternion is assumed to be normalised.

    Returns
    -------
    tuple of numpy.ndarray
        Rotation (3, 3) and translation (3,) in m, from the child frame to the parent frame.

    """
    moved = transform.transform
    q, t = moved.rotation, moved.translation
    x, y, z, w = q.x, q.y, q.z, q.w
    rotation = np.array(
        [
            [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
            [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
            [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
        ]
    )
    return rotation, np.array([t.x, t.y, t.z])


def transform_message(pose: Pose2D, frame: str, child: str, stamp: Any) -> TransformStamped:
    """
    Make the transform from a frame to its child.

    Parameters
    ----------
    pose
        The child frame in its parent: x, y (m) and yaw (rad).
    frame, child
        The names of the parent frame and of the child frame.
    stamp
        The time of the transform, a `builtin_interfaces/Time`.

    """
    message = TransformStamped(child_frame_id=child)
    message.header.frame_id, message.header.stamp = frame, stamp
    message.transform.translation.x = pose.x
    message.transform.translation.y = pose.y
    message.transform.rotation = make_quaternion(pose.yaw)
    return message


def cloud_bytes(particles: FloatArray, weights: FloatArray, frame: str, stamp: Any) -> bytes:
    """
    Serialise a `nav2_msgs/ParticleCloud`, without an object for each particle.

    The format is little-endian CDR: the header, the number of particles, and eight doubles for
    each, aligned to eight bytes.

    Parameters
    ----------
    particles
        Poses (N, 3): x, y (m) and yaw (rad).
    weights
        Their weights (N,).
    frame, stamp
        The header: the frame of the poses, and a `builtin_interfaces/Time`.

    """
    name = frame.encode() + b'\0'
    data = struct.pack('<iII', stamp.sec, stamp.nanosec, len(name)) + name
    data += b'\0' * (-len(data) % 4) + struct.pack('<I', len(particles))
    data += b'\0' * (-len(data) % 8)
    rows = np.zeros((len(particles), 8), '<f8')
    rows[:, :2] = particles[:, :2]
    rows[:, 5], rows[:, 6] = np.sin(0.5 * particles[:, 2]), np.cos(0.5 * particles[:, 2])
    rows[:, 7] = weights
    return b'\0\1\0\0' + data + rows.tobytes()
