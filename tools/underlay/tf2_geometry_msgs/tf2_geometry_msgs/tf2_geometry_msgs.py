# SPDX-License-Identifier: Apache-2.0
"""How messages of geometry_msgs are transformed; the registration with tf2_ros."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, TYPE_CHECKING, TypeVar

from geometry_msgs.msg import (
    Point,
    Point32,
    PointStamped,
    PolygonStamped,
    Pose,
    PoseStamped,
    PoseWithCovarianceStamped,
    Quaternion,
    TransformStamped,
    Vector3,
    Vector3Stamped,
    WrenchStamped,
)
from tf2_py.messages import pose_of
from tf2_py.poses import chain
from tf2_py.poses import Pose as PoseNumbers
from tf2_ros.buffer_interface import ConvertRegistration, TransformRegistration

if TYPE_CHECKING:
    import numpy

MessageT = TypeVar('MessageT')


def to_msg_msg(msg: MessageT) -> MessageT:
    """
    Convert a message to a message: return it as it is.

    Parameters
    ----------
    msg
        A message of any type.

    """
    return msg


def from_msg_msg(msg: MessageT) -> MessageT:
    """
    Convert a message from a message: return it as it is.

    Parameters
    ----------
    msg
        A message of any type.

    """
    return msg


def do_transform_point(point: PointStamped, transform: TransformStamped) -> PointStamped:
    """
    Transform a point to another frame.

    Parameters
    ----------
    point
        The point, in the child frame of the transform.
    transform
        The pose of that frame in the target frame; its header becomes that of the result.

    """
    return PointStamped(
        header=transform.header, point=_moved(Point, point.point, pose_of(transform.transform))
    )


def do_transform_vector3(vector3: Vector3Stamped, transform: TransformStamped) -> Vector3Stamped:
    """
    Rotate a free vector to another frame, without the translation.

    Parameters
    ----------
    vector3
        The vector, in the child frame of the transform.
    transform
        The pose of that frame in the target frame; its header becomes that of the result.

    """
    return Vector3Stamped(
        header=transform.header, vector=_turned(vector3.vector, pose_of(transform.transform))
    )


def do_transform_pose(pose: Pose, transform: TransformStamped) -> Pose:
    """
    Transform a pose without a header to another frame.

    Parameters
    ----------
    pose
        The pose, in the child frame of the transform.
    transform
        The pose of that frame in the target frame.

    Raises
    ------
    TypeError
        The pose is a PoseStamped, which `do_transform_pose_stamped` is for.

    """
    if isinstance(pose, PoseStamped):
        raise TypeError(
            'do_transform_pose takes a Pose and returns one, but this is a PoseStamped: use '
            'do_transform_pose_stamped, or pass its pose'
        )
    place, turn = pose.position, pose.orientation
    numbers = (place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w)
    x, y, z, qx, qy, qz, qw = chain(pose_of(transform.transform), numbers)
    return Pose(position=Point(x=x, y=y, z=z), orientation=Quaternion(x=qx, y=qy, z=qz, w=qw))


def do_transform_pose_stamped(pose: PoseStamped, transform: TransformStamped) -> PoseStamped:
    """
    Transform a pose to another frame.

    Parameters
    ----------
    pose
        The pose, in the child frame of the transform.
    transform
        The pose of that frame in the target frame; its header becomes that of the result.

    """
    return PoseStamped(header=transform.header, pose=do_transform_pose(pose.pose, transform))


def do_transform_pose_with_covariance_stamped(
    pose: PoseWithCovarianceStamped, transform: TransformStamped
) -> PoseWithCovarianceStamped:
    """
    Transform a pose and its covariance to another frame.

    Parameters
    ----------
    pose
        The pose, in the child frame of the transform.
    transform
        The pose of that frame in the target frame; its header becomes that of the result.

    """
    result = PoseWithCovarianceStamped(header=transform.header)
    result.pose.pose = do_transform_pose(pose.pose.pose, transform)
    result.pose.covariance = transform_covariance(pose.pose.covariance, transform)
    return result


def do_transform_polygon_stamped(
    polygon: PolygonStamped, transform: TransformStamped
) -> PolygonStamped:
    """
    Transform a polygon to another frame.

    Parameters
    ----------
    polygon
        The polygon, in the child frame of the transform.
    transform
        The pose of that frame in the target frame; its header becomes that of the result.

    """
    numbers = pose_of(transform.transform)
    result = PolygonStamped(header=transform.header)
    result.polygon.points = [_moved(Point32, point, numbers) for point in polygon.polygon.points]
    return result


def do_transform_wrench(wrench: WrenchStamped, transform: TransformStamped) -> WrenchStamped:
    """
    Rotate a wrench to another frame.

    Force and torque are rotated as vectors, as elsewhere in tf2: the torque stays that about the
    point where it was measured.

    Parameters
    ----------
    wrench
        The wrench, in the axes of the child frame of the transform.
    transform
        The pose of that frame in the target frame; its header becomes that of the result.

    """
    numbers = pose_of(transform.transform)
    result = WrenchStamped(header=transform.header)
    result.wrench.force = _turned(wrench.wrench.force, numbers)
    result.wrench.torque = _turned(wrench.wrench.torque, numbers)
    return result


def transform_covariance(
    cov_in: Iterable[float], transform: TransformStamped
) -> numpy.ndarray[Any, Any]:
    """
    Rotate the covariance of a pose to another frame.

    Parameters
    ----------
    cov_in
        36 numbers, (6, 6) by rows, of x, y, z and the rotations about x, y and z.
    transform
        The pose of their frame in the target frame, of which the rotation counts.

    Returns
    -------
    numpy.ndarray
        The same numbers (36,) in the axes of the target frame.

    """
    import numpy
    from scipy.spatial.transform import Rotation

    turn = transform.transform.rotation
    rotation = Rotation.from_quat([turn.x, turn.y, turn.z, turn.w]).as_matrix()
    both = numpy.kron(numpy.eye(2), rotation)
    covariance = numpy.asarray(cov_in, dtype=float).reshape(6, 6)
    result: numpy.ndarray[Any, Any] = (both @ covariance @ both.T).ravel()
    return result


def _moved(kind: type, point: Any, transform: PoseNumbers) -> Any:
    x, y, z = chain(transform, (point.x, point.y, point.z, 0.0, 0.0, 0.0, 1.0))[:3]
    return kind(x=x, y=y, z=z)


def _turned(vector: Any, transform: PoseNumbers) -> Vector3:
    rotation = (0.0, 0.0, 0.0, *transform[3:])
    x, y, z = chain(rotation, (vector.x, vector.y, vector.z, 0.0, 0.0, 0.0, 1.0))[:3]
    return Vector3(x=x, y=y, z=z)


_TRANSFORMS = {
    PointStamped: do_transform_point,
    PolygonStamped: do_transform_polygon_stamped,
    PoseStamped: do_transform_pose_stamped,
    PoseWithCovarianceStamped: do_transform_pose_with_covariance_stamped,
    Vector3Stamped: do_transform_vector3,
    WrenchStamped: do_transform_wrench,
}

for _kind, _transform in _TRANSFORMS.items():
    TransformRegistration().add(_kind, _transform)
    ConvertRegistration().add_to_msg(_kind, to_msg_msg)
    ConvertRegistration().add_from_msg(_kind, from_msg_msg)
