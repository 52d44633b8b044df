# SPDX-License-Identifier: Apache-2.0
"""Convert sensor messages to point arrays: scan, range, point cloud, polygon."""

from __future__ import annotations

from collections.abc import Sequence
import math
from typing import Any

import numpy as np
import numpy.typing as npt

__all__ = [
    'points_of_cloud',
    'points_of_polygon',
    'points_of_range',
    'points_of_scan',
    'transformed',
]

FloatArray = npt.NDArray[np.float64]
_MOST_SAMPLES = 100_000
_FLOAT32, _FLOAT64 = 7, 8  # sensor_msgs/PointField


def points_of_scan(
    ranges: Sequence[float],
    angle_min: float,
    angle_increment: float,
    range_min: float,
    range_max: float,
) -> FloatArray:
    """
    Convert a laser scan to (N, 3) hits in m in its frame.

    Parameters
    ----------
    ranges, angle_min, angle_increment, range_min, range_max
        As in `sensor_msgs/LaserScan`: m and rad. Ranges outside of the limits are not hits.

    Raises
    ------
    ValueError
        An angle is not finite, or a limit is NaN.

    """
    if not (math.isfinite(angle_min) and math.isfinite(angle_increment)):
        raise ValueError('The angles of the scan are not finite.')
    if math.isnan(range_min) or math.isnan(range_max):
        raise ValueError('The limits of the ranges of the scan are not numbers.')
    distances = np.asarray(ranges, dtype=np.float64)
    hits = np.flatnonzero((distances >= range_min) & (distances <= range_max))
    hits = hits[np.isfinite(distances[hits])]
    angles = angle_min + hits * angle_increment
    distances = distances[hits]
    return np.column_stack(
        [distances * np.cos(angles), distances * np.sin(angles), np.zeros(len(hits))]
    )


def points_of_range(
    distance: float,
    field_of_view: float,
    min_range: float,
    max_range: float,
    obstacles_angle: float,
) -> FloatArray:
    """
    Convert a range to the (N, 3) points of an arc across its field of view, in m in its frame.

    Parameters
    ----------
    distance, field_of_view, min_range, max_range
        As in `sensor_msgs/Range`: m and rad. A range outside of the limits yields no points.
    obstacles_angle
        The angle between two points in rad.

    """
    if not (math.isfinite(distance) and min_range <= distance <= max_range):
        return np.empty((0, 3))
    half = 0.5 * min(abs(field_of_view), 2.0 * math.pi)
    if not math.isfinite(half):
        return np.empty((0, 3))
    angles = np.append(np.arange(-half, half, max(obstacles_angle, 1e-3)), half)
    return np.column_stack(
        [distance * np.cos(angles), distance * np.sin(angles), np.zeros(len(angles))]
    )


def points_of_cloud(cloud: Any) -> FloatArray:
    """
    Extract the finite points of a point cloud.

    Parameters
    ----------
    cloud
        A `sensor_msgs/PointCloud2` in m.

    Returns
    -------
    numpy.ndarray
        Points (N, 3) in m, in the frame of the cloud.

    Raises
    ------
    ValueError
        It has no fields x, y and z of floating-point numbers, or too few bytes.

    """
    fields = {field.name: field for field in cloud.fields}
    if not {'x', 'y', 'z'} <= fields.keys():
        raise ValueError('The point cloud has no fields x, y and z.')
    order = '>' if cloud.is_bigendian else '<'
    kinds = {_FLOAT32: order + 'f4', _FLOAT64: order + 'f8'}
    used = [fields[name] for name in 'xyz']
    if any(field.datatype not in kinds for field in used):
        raise ValueError(
            'The fields x, y and z of the point cloud are not floating-point numbers.'
        )
    count = cloud.width * cloud.height
    if not count:
        return np.empty((0, 3))
    kind = np.dtype(
        {
            'names': ['x', 'y', 'z'],
            'formats': [kinds[field.datatype] for field in used],
            'offsets': [field.offset for field in used],
            'itemsize': cloud.point_step,
        }
    )
    if len(cloud.data) < cloud.row_step * (cloud.height - 1) + cloud.width * cloud.point_step:
        raise ValueError('The point cloud has fewer bytes than its size requires.')
    rows = np.ndarray(
        (cloud.height, cloud.width), kind, cloud.data, strides=(cloud.row_step, cloud.point_step)
    )
    points = np.stack([rows[name].ravel() for name in 'xyz'], axis=1).astype(np.float64)
    return np.asarray(points[np.isfinite(points).all(axis=1)])


def points_of_polygon(corners: FloatArray, distance: float) -> FloatArray:
    """
    Sample (N, 3) points along the outline of a polygon.

    Parameters
    ----------
    corners
        (M, 2) array in m.
    distance
        The spacing of the points, in m.

    """
    corners = corners[np.isfinite(corners).all(axis=1)]
    if not len(corners):
        return np.empty((0, 3))
    ends = np.roll(corners, -1, axis=0)
    lengths = np.hypot(*(ends - corners).T)
    distance = max(distance, float(lengths.sum()) / _MOST_SAMPLES, 1e-6)
    edges = []
    for start, end, length in zip(corners, ends, lengths):
        parts = np.arange(0.0, max(length, 1e-9), distance) / max(length, 1e-9)
        edges.append(start + parts[:, np.newaxis] * (end - start))
    points = np.concatenate(edges)
    return np.column_stack([points, np.zeros(len(points))])


def transformed(points: FloatArray, matrix: FloatArray) -> FloatArray:
    """
    Transform points to another frame.

    Parameters
    ----------
    points
        Points (N, 3) in m.
    matrix
        Rotation and translation (3, 4), from the frame of the points to the target frame.

    Returns
    -------
    numpy.ndarray
        Points (N, 3) in m.

    """
    return np.asarray(points @ matrix[:, :3].T + matrix[:, 3])
