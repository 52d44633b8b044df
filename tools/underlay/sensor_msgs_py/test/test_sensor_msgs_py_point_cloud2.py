# SPDX-License-Identifier: Apache-2.0
"""Point clouds read and made with NumPy."""

from __future__ import annotations

import struct

import numpy as np
import pytest
from sensor_msgs.msg import PointCloud2, PointField
from sensor_msgs_py import point_cloud2
from std_msgs.msg import Header

FIELDS = [
    PointField(name='x', offset=0, datatype=PointField.FLOAT32, count=1),
    PointField(name='y', offset=4, datatype=PointField.FLOAT32, count=1),
    PointField(name='ring', offset=12, datatype=PointField.UINT16, count=1),
]
POINTS = [(1.0, 2.0, 3), (4.0, float('nan'), 6), (7.0, 8.0, 9), (0.5, 0.25, 12)]


@pytest.fixture
def cloud() -> PointCloud2:
    """Return an organized cloud of 2 by 2 points, packed by hand, with gaps and padded rows."""
    packed = [struct.pack('<ff4xHxx', *point) for point in POINTS]
    rows = [packed[0] + packed[1] + b'\xff' * 4, packed[2] + packed[3] + b'\xff' * 4]
    return PointCloud2(
        header=Header(frame_id='lidar'),
        height=2,
        width=2,
        fields=FIELDS,
        point_step=16,
        row_step=36,
        data=b''.join(rows),
    )


def test_points_are_read_by_name(cloud: PointCloud2) -> None:
    """Each field has its type and its values, whatever lies between points and rows."""
    points = point_cloud2.read_points(cloud)
    assert points.dtype.names == ('x', 'y', 'ring')
    assert points['x'].tolist() == [1.0, 4.0, 7.0, 0.5]
    assert points['ring'].tolist() == [3, 6, 9, 12]
    assert points['ring'].dtype == np.uint16


def test_points_without_nan_and_chosen_ones(cloud: PointCloud2) -> None:
    """NaN counts in the fields that are read; points are chosen by index, or column and row."""
    read = point_cloud2.read_points
    assert read(cloud, skip_nans=True)['ring'].tolist() == [3, 9, 12]
    assert len(read(cloud, ['x', 'ring'], skip_nans=True)) == 4
    assert read(cloud, uvs=[0, 2])['ring'].tolist() == [3, 9]
    assert read(cloud, uvs=[(1, 0), (0, 1)])['ring'].tolist() == [6, 9]


def test_arrays_of_numbers(cloud: PointCloud2) -> None:
    """Fields of one type become an array; others are refused with the types."""
    xy = point_cloud2.read_points_numpy(cloud, ['x', 'y'])
    assert xy.shape == (4, 2)
    assert xy[2].tolist() == [7.0, 8.0]
    shaped = point_cloud2.read_points_numpy(cloud, ['x', 'y'], reshape_organized_cloud=True)
    assert shaped.shape == (2, 2, 2)
    with pytest.raises(ValueError, match='fields of one type, .* ring: uint16'):
        point_cloud2.read_points_numpy(cloud)


def test_named_tuples(cloud: PointCloud2) -> None:
    """Points have their fields as attributes, as plain numbers."""
    first = point_cloud2.read_points_list(cloud)[0]
    assert (first.x, first.ring) == (1.0, 3)
    assert isinstance(first.ring, int)


@pytest.mark.parametrize(
    ('kwargs', 'message'),
    [
        ({'field_names': ['intensity']}, "no field 'intensity'; it has 'x', 'y', 'ring'"),
        ({'uvs': [4]}, 'outside the cloud, which has 4 points'),
        ({'uvs': [0], 'reshape_organized_cloud': True}, 'cannot be reshaped'),
    ],
)
def test_what_a_cloud_does_not_have(
    cloud: PointCloud2, kwargs: dict[str, object], message: str
) -> None:
    """Unknown fields and points are errors that say what there is."""
    with pytest.raises(ValueError, match=message):
        point_cloud2.read_points(cloud, **kwargs)  # type: ignore[arg-type]


def test_big_endian_and_empty_clouds() -> None:
    """The byte order of the message is respected; a cloud without points gives none."""
    cloud = PointCloud2(
        height=1, width=1, fields=FIELDS[:1], point_step=4, row_step=4, is_bigendian=True
    )
    cloud.data = struct.pack('>f', 2.5)
    assert point_cloud2.read_points(cloud)['x'].tolist() == [2.5]
    assert len(point_cloud2.read_points_numpy(PointCloud2(fields=FIELDS[:1], point_step=4))) == 0


def test_clouds_of_lists_and_arrays() -> None:
    """Points of any form make the same cloud, which reads back as it was."""
    header = Header(frame_id='map')
    numbers = [(1.0, 2.0, 3.0), (4.0, 5.0, 6.0)]
    of_list = point_cloud2.create_cloud_xyz32(header, numbers)
    of_array = point_cloud2.create_cloud_xyz32(header, np.array(numbers))
    again = point_cloud2.create_cloud_xyz32(header, point_cloud2.read_points(of_list))
    assert of_list == of_array == again
    assert (of_list.width, of_list.height, of_list.point_step, of_list.row_step) == (2, 1, 12, 24)
    assert of_list.header.frame_id == 'map'
    assert point_cloud2.read_points_numpy(of_array).tolist() == [list(point) for point in numbers]


def test_clouds_with_other_fields(cloud: PointCloud2) -> None:
    """Fields keep their offsets and types; a wrong number of values is an error."""
    made = point_cloud2.create_cloud(Header(), FIELDS, POINTS, point_step=16)
    assert made.point_step == 16
    assert point_cloud2.read_points(made)['ring'].tolist() == [3, 6, 9, 12]
    organized = point_cloud2.create_cloud_xyz32(Header(), np.zeros((4, 3, 3)))
    assert (organized.width, organized.height) == (4, 3)
    with pytest.raises(ValueError, match=r'have 2 numbers each, but there are 3 fields \(x, y, z'):
        point_cloud2.create_cloud_xyz32(Header(), np.zeros((5, 2)))


def test_fields_of_several_elements_and_without_a_name() -> None:
    """Elements are numbered, and a field without a name is called after its place."""
    fields = [
        PointField(name='', offset=0, datatype=PointField.FLOAT64, count=1),
        PointField(name='normal', offset=8, datatype=PointField.FLOAT32, count=2),
    ]
    kind = point_cloud2.dtype_from_fields(fields, point_step=24)
    assert kind.names == ('unnamed_field_0', 'normal_0', 'normal_1')
    assert kind.itemsize == 24
