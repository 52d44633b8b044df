# SPDX-License-Identifier: Apache-2.0
"""Points of clouds and scans, and their colours."""

import struct

import numpy as np
import pytest
from rviz_default_plugins.decoding.clouds import (
    Cloud,
    colors_rgb8,
    colors_rgbf32,
    decode_cloud,
    decode_scan,
    rainbow,
    Scale,
)
from sensor_msgs.msg import LaserScan, PointCloud2, PointField

NAN, INF = float('nan'), float('inf')
XYZ = [('x', 0, 7), ('y', 4, 7), ('z', 8, 7)]


def message_of(fields, data, width, height=1, step=12, row=None, is_bigendian=False):
    """Return a cloud of bytes."""
    return PointCloud2(
        fields=[
            PointField(name=name, offset=offset, datatype=kind, count=1)
            for name, offset, kind in fields
        ],
        data=data,
        width=width,
        height=height,
        point_step=step,
        row_step=width * step if row is None else row,
        is_bigendian=is_bigendian,
    )


def test_points_and_channels():
    """Points and further fields are read at their offsets, with padding between."""
    data = struct.pack('<fffxxxxH', 1, 2, 3, 500) + b'..' + struct.pack('<fffxxxxH', 4, 5, 6, 7)
    cloud = decode_cloud(message_of([*XYZ, ('ring', 16, 4)], data + b'..', 2, step=20))
    assert cloud.points.tolist() == [[1, 2, 3], [4, 5, 6]]
    assert cloud.channels['ring'].tolist() == [500, 7]


@pytest.mark.parametrize(
    ('datatype', 'code', 'value'),
    [
        (1, 'b', -7),
        (2, 'B', 250),
        (3, 'h', -700),
        (4, 'H', 65000),
        (5, 'i', -70000),
        (6, 'I', 4000000000),
        (7, 'f', 0.5),
        (8, 'd', 1e-3),
    ],
)
@pytest.mark.parametrize('order', '<>')
def test_all_types_of_fields_in_both_orders(datatype, code, value, order):
    """Each type of field is read, with either byte first."""
    data = struct.pack(f'{order}fff{code}', 1, 2, 3, value)
    fields = [*XYZ, ('value', 12, datatype)]
    cloud = decode_cloud(message_of(fields, data, 1, step=len(data), is_bigendian=order == '>'))
    assert cloud.points.tolist() == [[1, 2, 3]]
    assert cloud.channels['value'][0] == pytest.approx(value)


def test_positions_of_whole_and_double_numbers():
    """Positions need not be of 32 bits."""
    data = struct.pack('<dhb', 1.5, -2, 3)
    cloud = decode_cloud(message_of([('x', 0, 8), ('y', 8, 3), ('z', 10, 1)], data, 1, step=11))
    assert cloud.points.tolist() == [[1.5, -2, 3]]


def test_organised_cloud_with_padded_rows():
    """The rows of an organised cloud may be longer than their points; the last need not be."""
    one, two = struct.pack('<fff', 1, 2, 3), struct.pack('<fff', 4, 5, 6)
    cloud = decode_cloud(message_of(XYZ, one + b'pad.' + two, 1, 2, row=16))
    assert cloud.points.tolist() == [[1, 2, 3], [4, 5, 6]]


def test_points_that_are_nowhere_are_dropped():
    """What is not finite is no point; its channels go too."""
    points = np.array([[1, 2, 3], [NAN, 0, 0], [0, INF, 0]], np.float32)
    cloud = Cloud(points, {'i': np.array([1, 2, 3])}).finite()
    assert cloud.points.tolist() == [[1, 2, 3]]
    assert cloud.channels['i'].tolist() == [1]


def test_thinning_leaves_not_more_than_asked():
    """Each n-th point is left; few points are left alone."""
    cloud = Cloud(np.zeros((1001, 3), np.float32), {'i': np.arange(1001)})
    assert cloud.thinned(100).channels['i'][:3].tolist() == [0, 11, 22]
    assert len(cloud.thinned(100)) == 91
    assert cloud.thinned(1001) is cloud


@pytest.mark.parametrize(
    ('message', 'reason'),
    [
        (message_of(XYZ, b'1234', 1), '4 bytes of data, but 1 x 1 points need 12'),
        (message_of(XYZ[:2], b'.' * 12, 1), 'no field z; its fields are x, y'),
        (message_of([], b'', 0), 'no field x; its fields are none'),
        (message_of([('x', 0, 99)], b'.' * 12, 1), "field 'x' has the unknown type 99"),
        (message_of([('x', 10, 7)], b'.' * 12, 1), "field 'x' ends at byte 14 of a point"),
        (message_of(XYZ, b'.' * 24, 2, 2, row=5), 'rows of 5 bytes are too short'),
        (message_of(XYZ, b'', 2**31, 2**31, row=2**32 - 1), 'rows of'),
    ],
)
def test_broken_clouds_are_refused(message, reason):
    """What is wrong with a cloud is said."""
    with pytest.raises(ValueError, match=reason):
        decode_cloud(message)


def test_cloud_without_points():
    """A cloud may be empty, with or without a size of points."""
    assert len(decode_cloud(message_of(XYZ, b'', 0))) == 0
    assert len(decode_cloud(message_of(XYZ, b'', 0, 5))) == 0


def test_packed_colors():
    """Colours are the bytes of a number, which may be declared as float."""
    number = 0x00FF8001
    as_float = np.array([struct.unpack('<f', struct.pack('<I', number))[0]], '<f4')
    for packed in (np.array([number], '<u4'), as_float, np.array([number], '>u4')):
        assert colors_rgb8(Cloud(np.zeros((1, 3)), {'rgb': packed})).tolist() == [[255, 128, 1]]
    assert colors_rgb8(Cloud(np.zeros((1, 3)), {'rgba': np.array([1], '<u4')})).tolist() == [
        [0, 0, 1]
    ]
    assert colors_rgb8(Cloud(np.zeros((1, 3)))) is None
    assert colors_rgb8(Cloud(np.zeros((1, 3)), {'rgb': np.array([1], 'u1')})) is None


def test_colors_of_floats():
    """Colours of three fields are from 0 to 1."""
    channels = {'r': np.array([0.5]), 'g': np.array([2.0]), 'b': np.array([NAN])}
    assert colors_rgbf32(Cloud(np.zeros((1, 3)), channels)).tolist() == [[128, 255, 0]]
    assert colors_rgbf32(Cloud(np.zeros((1, 3)), {'r': np.array([1.0])})) is None


def test_rainbow_has_the_colors_of_rviz():
    """From 0 to 1: magenta, blue, cyan, green, yellow, red."""
    assert rainbow(np.linspace(0, 1, 6)).tolist() == [
        [255, 0, 255],
        [0, 0, 255],
        [0, 255, 255],
        [0, 255, 0],
        [255, 255, 0],
        [255, 0, 0],
    ]


def test_scale_of_the_values_themselves():
    """The least value is red and the greatest magenta; inverted it is the other way."""
    values = np.array([10, 20, 30], np.uint16)
    assert Scale().paint(values)[[0, 2]].tolist() == [[255, 0, 0], [255, 0, 255]]
    assert Scale(is_inverted=True).paint(values)[0].tolist() == [255, 0, 255]


def test_scale_between_two_colors():
    """Without rainbow colours run between two, and stay there beyond the limits."""
    scale = Scale(0.0, 10.0, False, colors=((0, 0, 0), (200, 100, 0)))
    painted = scale.paint(np.array([-5.0, 5.0, 50.0, NAN])).tolist()
    assert painted == [[0, 0, 0], [100, 50, 0], [200, 100, 0], [0, 0, 0]]


@pytest.mark.parametrize('values', [[], [7, 7], [NAN, NAN], [INF, 1.0]])
def test_scale_of_strange_values(values):
    """Equal values, none, and those that are not finite have colours too."""
    assert Scale().paint(np.array(values, float)).shape == (len(values), 3)


def test_scan_becomes_points():
    """Ranges between the limits become points at their angles, with their intensities."""
    scan = LaserScan(
        angle_min=0.0,
        angle_increment=np.pi / 2,
        range_min=0.1,
        range_max=10.0,
        ranges=[1.0, 2.0, 0.01, INF, NAN, 11.0],
        intensities=[5.0, 6.0, 7.0, 8.0, 9.0, 10.0],
    )
    cloud = decode_scan(scan)
    assert cloud.points == pytest.approx(np.array([[1, 0, 0], [0, 2, 0]]), abs=1e-6)
    assert cloud.channels['intensity'].tolist() == [5, 6]


def test_strange_scans():
    """Scans may be empty, and have no or a wrong number of intensities; angles must be finite."""
    assert len(decode_scan(LaserScan())) == 0
    scan = LaserScan(range_max=9.0, ranges=[1.0, 2.0], intensities=[1.0])
    assert decode_scan(scan).channels == {}
    with pytest.raises(ValueError, match='angles'):
        decode_scan(LaserScan(angle_increment=NAN, ranges=[1.0]))
