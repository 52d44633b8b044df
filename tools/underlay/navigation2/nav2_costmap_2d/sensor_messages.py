# SPDX-License-Identifier: Apache-2.0
"""Extract the points of sensor messages."""

from __future__ import annotations

import functools
import math
from typing import Any

from geometry_msgs.msg import Transform
from nav2_costmap_2d.grid import FloatArray
from nav2_costmap_2d.raytracing import Observation
import numpy as np
import numpy.typing as npt
from sensor_msgs.msg import LaserScan, PointCloud2, PointField

__all__ = ['cloud_points', 'observation_of', 'rotation_of', 'scan_points']

_KINDS = {
    PointField.INT8: 'i1',
    PointField.UINT8: 'u1',
    PointField.INT16: 'i2',
    PointField.UINT16: 'u2',
    PointField.INT32: 'i4',
    PointField.UINT32: 'u4',
    PointField.FLOAT32: 'f4',
    PointField.FLOAT64: 'f8',
}


@functools.lru_cache(maxsize=8)
def _directions(start_rad: float, step_rad: float, count: int) -> FloatArray:
    angles = start_rad + step_rad * np.arange(count)
    return np.column_stack([np.cos(angles), np.sin(angles), np.zeros(count)])


def scan_points(
    scan: LaserScan, *, inf_is_valid: bool
) -> tuple[FloatArray, npt.NDArray[np.bool_] | None]:
    """
    Extract the points of a scan, in the frame of the sensor.

    Parameters
    ----------
    scan
        The message.
    inf_is_valid
        Whether a beam without a hit is free up to the range of the sensor.

    Returns
    -------
    (N, 3) points in m, and (N,) whether each is a surface; None if all are.

    """
    ranges = np.asarray(scan.ranges, float)
    directions = _directions(scan.angle_min, scan.angle_increment, len(ranges))
    is_hit = (ranges >= scan.range_min) & (ranges <= scan.range_max)
    if not inf_is_valid:
        return directions[is_hit] * ranges[is_hit, None], None
    is_free = np.isposinf(ranges)
    valid = is_hit | is_free
    lengths = np.where(is_free, scan.range_max, ranges)[valid]
    return directions[valid] * lengths[:, None], is_hit[valid]


def cloud_points(cloud: PointCloud2) -> FloatArray:
    """
    Extract the finite points of a cloud.

    Parameters
    ----------
    cloud
        A cloud in m, with fields x, y and z of any numeric type.

    Returns
    -------
    numpy.ndarray
        Points (N, 3) in m, in the frame of the sensor.

    Raises
    ------
    ValueError
        It has no fields x, y and z, or less data than it states; the text is a full sentence.

    """
    fields = {field.name: field for field in cloud.fields}
    missing = [name for name in 'xyz' if name not in fields]
    if missing:
        raise ValueError(f"The cloud has no field '{missing[0]}'; it has {', '.join(fields)}.")
    order = '>' if cloud.is_bigendian else '<'
    data: Any = memoryview(cloud.data)
    points = np.empty((cloud.height, cloud.width, 3))
    for index, name in enumerate('xyz'):
        try:
            points[..., index] = np.ndarray(
                (cloud.height, cloud.width),
                order + _KINDS[fields[name].datatype],
                data,
                fields[name].offset,
                (cloud.row_step, cloud.point_step),
            )
        except (TypeError, KeyError, ValueError):
            raise ValueError(
                f"The field '{name}' of the cloud, or its size of {len(data)} bytes, does not fit "
                'its description.'
            ) from None
    flat = points.reshape(-1, 3)
    finite: FloatArray = flat[np.isfinite(flat).all(axis=1)]
    return finite


def rotation_of(transform: Transform) -> FloatArray:
    """
    Convert the rotation of a transform to a matrix.

    Parameters
    ----------
    transform
        The transform; its quaternion need not be normalised.

    Returns
    -------
    numpy.ndarray
        Rotation (3, 3), from the child frame to the parent frame.

    """
    q = transform.rotation
    x, y, z, w = q.x, q.y, q.z, q.w
    scale = 2.0 / max(x * x + y * y + z * z + w * w, 1e-12)
    rotation: FloatArray = np.array(
        [
            [1.0 - scale * (y * y + z * z), scale * (x * y - z * w), scale * (x * z + y * w)],
            [scale * (x * y + z * w), 1.0 - scale * (x * x + z * z), scale * (y * z - x * w)],
            [scale * (x * z - y * w), scale * (y * z + x * w), 1.0 - scale * (x * x + y * y)],
        ]
    )
    return rotation


def observation_of(
    points: FloatArray,
    is_hit: npt.NDArray[np.bool_] | None,
    transform: Transform,
    heights_m: tuple[float, float] = (-math.inf, math.inf),
) -> Observation:
    """
    Transform points of a sensor to the frame of a costmap.

    Parameters
    ----------
    points, is_hit
        As `scan_points` returns them.
    transform
        The pose of the sensor in the frame of the costmap.
    heights_m
        The height limits in the frame of the costmap; points outside of them are dropped.

    """
    at = transform.translation
    origin = np.array([at.x, at.y, at.z])
    moved = points @ rotation_of(transform).T + origin
    keep = (moved[:, 2] >= heights_m[0]) & (moved[:, 2] <= heights_m[1])
    if not keep.all():
        moved, is_hit = moved[keep], None if is_hit is None else is_hit[keep]
    return Observation(origin, moved, is_hit)
