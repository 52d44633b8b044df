# SPDX-License-Identifier: Apache-2.0
"""How point clouds are transformed; the registration with tf2_ros."""

from __future__ import annotations

from geometry_msgs.msg import Transform, TransformStamped
import numpy as np
from scipy.spatial.transform import Rotation
from sensor_msgs.msg import PointCloud2
from sensor_msgs_py.point_cloud2 import create_cloud, read_points
from tf2_geometry_msgs import from_msg_msg, to_msg_msg
from tf2_ros.buffer_interface import ConvertRegistration, TransformRegistration

__all__ = ['do_transform_cloud', 'from_msg_msg', 'to_msg_msg', 'transform_points']

_PLACE = ('x', 'y', 'z')
_NORMAL = ('normal_x', 'normal_y', 'normal_z')


def transform_points(point_cloud: np.ndarray, transform: Transform) -> np.ndarray:
    """
    Transform points to another frame.

    Parameters
    ----------
    point_cloud
        The points, of shape (N, 3), in m.
    transform
        The pose of their frame in the target frame.

    Returns
    -------
    numpy.ndarray
        The points in the target frame, of shape (N, 3), in m.

    """
    move = transform.translation
    moved: np.ndarray = _turn(transform).apply(point_cloud) + (move.x, move.y, move.z)
    return moved


def do_transform_cloud(cloud: PointCloud2, transform: TransformStamped) -> PointCloud2:
    """
    Transform a point cloud to another frame: its points, and their normals if it has some.

    Parameters
    ----------
    cloud
        The cloud, in the child frame of the transform, with fields x, y and z.
    transform
        The pose of that frame in the target frame; its header becomes that of the result.

    Returns
    -------
    PointCloud2
        A cloud with the same fields, as wide and high as before.

    Raises
    ------
    ValueError
        The cloud does not have the fields x, y and z.

    """
    points = read_points(cloud)
    names = points.dtype.names or ()
    if not set(_PLACE) <= set(names):
        raise ValueError(
            'Only a cloud with the fields x, y and z can be transformed; this one has '
            f'{", ".join(names) or "none"}'
        )
    _set(points, _PLACE, transform_points(_get(points, _PLACE), transform.transform))
    if set(_NORMAL) <= set(names):
        _set(points, _NORMAL, _turn(transform.transform).apply(_get(points, _NORMAL)))
    moved = create_cloud(transform.header, cloud.fields, points, cloud.point_step)
    moved.width, moved.height, moved.is_dense = cloud.width, cloud.height, cloud.is_dense
    moved.row_step = cloud.point_step * cloud.width
    return moved


def _turn(transform: Transform) -> Rotation:
    turn = transform.rotation
    return Rotation.from_quat((turn.x, turn.y, turn.z, turn.w))


def _get(points: np.ndarray, names: tuple[str, ...]) -> np.ndarray:
    return np.stack([points[name].astype(float) for name in names], axis=-1)


def _set(points: np.ndarray, names: tuple[str, ...], values: np.ndarray) -> None:
    for index, name in enumerate(names):
        points[name] = values[:, index]


TransformRegistration().add(PointCloud2, do_transform_cloud)
ConvertRegistration().add_to_msg(PointCloud2, to_msg_msg)
ConvertRegistration().add_from_msg(PointCloud2, from_msg_msg)
