# SPDX-License-Identifier: Apache-2.0
"""Point clouds in other frames."""

from __future__ import annotations

from geometry_msgs.msg import TransformStamped
import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from sensor_msgs.msg import PointCloud2, PointField
from sensor_msgs_py import point_cloud2
from std_msgs.msg import Header
from tf2_ros import Buffer
import tf2_sensor_msgs

TURN = Rotation.from_rotvec([0.3, -0.7, 1.1])
MOVE = np.array([1.0, -2.0, 3.0])
POINTS = np.array([[0.0, 0.0, 0.0], [1.0, 2.0, 3.0], [-4.0, 0.5, 6.0]])


@pytest.fixture
def transform() -> TransformStamped:
    """Return the transform of the constants."""
    result = TransformStamped(child_frame_id='lidar')
    result.header.frame_id = 'map'
    place, turn = result.transform.translation, result.transform.rotation
    place.x, place.y, place.z = MOVE.tolist()
    turn.x, turn.y, turn.z, turn.w = TURN.as_quat().tolist()
    return result


def test_cloud_in_another_frame(transform: TransformStamped) -> None:
    """A buffer transforms the points of a cloud, which then is in the target frame."""
    buffer = Buffer()
    buffer.set_transform_static(transform, 'test')
    cloud = point_cloud2.create_cloud_xyz32(Header(frame_id='lidar'), POINTS)
    moved = buffer.transform(cloud, 'map')
    assert moved.header.frame_id == 'map'
    expected = TURN.apply(POINTS) + MOVE
    assert point_cloud2.read_points_numpy(moved) == pytest.approx(expected, abs=1e-5)
    assert point_cloud2.read_points_numpy(cloud).tolist() == POINTS.tolist()
    of_array = tf2_sensor_msgs.transform_points(POINTS, transform.transform)
    assert of_array == pytest.approx(expected)


def test_normals_turn_and_other_fields_stay(transform: TransformStamped) -> None:
    """Normals are only turned; other fields, the size and the layout stay."""
    names = ('x', 'y', 'z', 'normal_x', 'normal_y', 'normal_z', 'intensity')
    fields = [
        PointField(name=name, offset=4 * index, datatype=PointField.FLOAT32, count=1)
        for index, name in enumerate(names)
    ]
    rows = [(*point, 0.0, 0.0, 1.0, 42.0) for point in POINTS[:2]]
    cloud = point_cloud2.create_cloud(Header(), fields, rows, point_step=32)
    cloud.width, cloud.height, cloud.row_step, cloud.is_dense = 1, 2, 32, True
    moved = tf2_sensor_msgs.do_transform_cloud(cloud, transform)
    assert (moved.width, moved.height, moved.point_step, moved.row_step) == (1, 2, 32, 32)
    assert moved.is_dense
    assert moved.fields == fields
    read = point_cloud2.read_points_numpy(moved)
    assert read[:, 3:6] == pytest.approx(TURN.apply([[0.0, 0.0, 1.0]] * 2), abs=1e-6)
    assert read[:, 6].tolist() == [42.0, 42.0]


def test_cloud_without_coordinates(transform: TransformStamped) -> None:
    """A cloud without x, y and z is refused with the fields that it has."""
    cloud = PointCloud2(
        width=1,
        height=1,
        point_step=4,
        row_step=4,
        data=b'0000',
        fields=[PointField(name='u', offset=0, datatype=PointField.FLOAT32, count=1)],
    )
    with pytest.raises(ValueError, match='x, y and z can be transformed; this one has u'):
        tf2_sensor_msgs.do_transform_cloud(cloud, transform)
