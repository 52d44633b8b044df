# SPDX-License-Identifier: Apache-2.0
"""Messages in other frames, against scipy."""

from __future__ import annotations

from typing import Any

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
import numpy as np
import pytest
from scipy.spatial.transform import Rotation
import tf2_geometry_msgs
from tf2_ros import Buffer, convert, TypeException

ROTATION = Rotation.from_rotvec([0.3, -0.7, 1.1])
TRANSLATION = np.array([1.0, -2.0, 3.0])


@pytest.fixture
def transform() -> TransformStamped:
    """Return the transform of the constants."""
    result = TransformStamped(child_frame_id='sensor')
    result.header.frame_id = 'map'
    place, turn = result.transform.translation, result.transform.rotation
    place.x, place.y, place.z = TRANSLATION.tolist()
    turn.x, turn.y, turn.z, turn.w = ROTATION.as_quat().tolist()
    return result


def test_pose_and_stamped_pose(buffer: Buffer, transform: TransformStamped) -> None:
    """Who takes one for the other is told which function is meant, and what has a frame."""
    with pytest.raises(TypeError, match='this is a PoseStamped: use do_transform_pose_stamped'):
        tf2_geometry_msgs.do_transform_pose(PoseStamped(), transform)
    with pytest.raises(TypeException, match='A Pose has no header, .* as PoseStamped, or'):
        buffer.transform(Pose(), 'map')


@pytest.fixture
def buffer(transform: TransformStamped) -> Buffer:
    """Return a buffer with the transform."""
    buffer = Buffer()
    buffer.set_transform_static(transform, 'test')
    return buffer


def xyz(value: Any) -> list[float]:
    """Return the numbers of a point or vector."""
    return [value.x, value.y, value.z]


def in_sensor(message: Any) -> Any:
    """Put a message into the frame of the sensor."""
    message.header.frame_id = 'sensor'
    return message


def test_point(buffer: Buffer) -> None:
    """A point is turned and moved."""
    point = in_sensor(PointStamped(point=Point(x=1.0, y=2.0, z=3.0)))
    result = buffer.transform(point, 'map')
    expected = ROTATION.apply([1, 2, 3]) + TRANSLATION
    assert xyz(result.point) == pytest.approx(expected, abs=1e-12)
    assert result.header.frame_id == 'map'
    back = buffer.transform(result, 'sensor')
    assert xyz(back.point) == pytest.approx([1, 2, 3])


def test_vector(buffer: Buffer) -> None:
    """A vector is only turned."""
    vector = in_sensor(Vector3Stamped(vector=Vector3(x=1.0, y=2.0, z=3.0)))
    result = buffer.transform(vector, 'map')
    assert xyz(result.vector) == pytest.approx(ROTATION.apply([1, 2, 3]), abs=1e-12)


def pose() -> Pose:
    """Return a pose."""
    x, y, z, w = Rotation.from_rotvec([1, 2, 0.5]).as_quat().tolist()
    return Pose(position=Point(x=4.0, y=5.0, z=6.0), orientation=Quaternion(x=x, y=y, z=z, w=w))


def assert_moved(result: Pose) -> None:
    """Compare a pose in the map with the one in the sensor."""
    expected = ROTATION.apply([4, 5, 6]) + TRANSLATION
    assert xyz(result.position) == pytest.approx(expected, abs=1e-12)
    turn = result.orientation
    rotation = Rotation.from_quat([turn.x, turn.y, turn.z, turn.w])
    other = ROTATION * Rotation.from_rotvec([1, 2, 0.5])
    assert (rotation.inv() * other).magnitude() < 1e-12


def test_poses(buffer: Buffer, transform: TransformStamped) -> None:
    """A pose is turned and moved, with and without a header."""
    assert_moved(tf2_geometry_msgs.do_transform_pose(pose(), transform))
    assert_moved(buffer.transform(in_sensor(PoseStamped(pose=pose())), 'map').pose)


def test_covariance(buffer: Buffer) -> None:
    """The covariance of a pose turns with it."""
    generator = np.random.default_rng(2)
    root = generator.normal(size=(6, 6))
    covariance = root @ root.T
    message = in_sensor(PoseWithCovarianceStamped())
    message.pose.pose = pose()
    message.pose.covariance = covariance.ravel()
    result = buffer.transform(message, 'map')
    assert_moved(result.pose.pose)
    turned = result.pose.covariance.reshape(6, 6)
    matrix = ROTATION.as_matrix()
    np.testing.assert_allclose(turned[:3, :3], matrix @ covariance[:3, :3] @ matrix.T)
    np.testing.assert_allclose(turned[:3, 3:], matrix @ covariance[:3, 3:] @ matrix.T)
    np.testing.assert_allclose(np.linalg.eigvalsh(turned), np.linalg.eigvalsh(covariance))


def test_polygon(buffer: Buffer) -> None:
    """All points of a polygon are moved, in the precision of its numbers."""
    polygon = in_sensor(PolygonStamped())
    polygon.polygon.points = [Point32(x=1.0), Point32(y=2.0)]
    result = buffer.transform(polygon, 'map').polygon.points
    assert xyz(result[1]) == pytest.approx(ROTATION.apply([0, 2, 0]) + TRANSLATION, abs=1e-5)
    assert len(result) == 2


def test_wrench(buffer: Buffer) -> None:
    """Force and torque are turned."""
    wrench = in_sensor(WrenchStamped())
    wrench.wrench.force = Vector3(x=1.0)
    wrench.wrench.torque = Vector3(y=2.0)
    result = buffer.transform(wrench, 'map').wrench
    assert xyz(result.force) == pytest.approx(ROTATION.apply([1, 0, 0]), abs=1e-12)
    assert xyz(result.torque) == pytest.approx(ROTATION.apply([0, 2, 0]), abs=1e-12)


def test_messages_are_their_own_conversion() -> None:
    """A message converted to its type is equal, and another object."""
    message = in_sensor(PointStamped())
    assert convert(message, PointStamped) == message
    assert tf2_geometry_msgs.to_msg_msg(message) is message
    assert tf2_geometry_msgs.from_msg_msg(message) is message


def test_input_stays(buffer: Buffer) -> None:
    """A transformation leaves its input alone."""
    point = in_sensor(PointStamped(point=Point(x=1.0)))
    buffer.transform(point, 'map')
    assert point.header.frame_id == 'sensor' and point.point.x == 1.0
