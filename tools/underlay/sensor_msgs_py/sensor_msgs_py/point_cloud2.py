# SPDX-License-Identifier: Apache-2.0
"""Point clouds as NumPy arrays, and the other way round."""

from __future__ import annotations

import array
from collections import namedtuple
from collections.abc import Iterable
import sys
from typing import Any

import numpy as np
from numpy.lib.recfunctions import structured_to_unstructured, unstructured_to_structured
from sensor_msgs.msg import PointCloud2, PointField
from std_msgs.msg import Header

__all__ = [
    'create_cloud',
    'create_cloud_xyz32',
    'dtype_from_fields',
    'read_points',
    'read_points_list',
    'read_points_numpy',
]

DUMMY_FIELD_PREFIX = 'unnamed_field'
_TYPES: dict[int, np.dtype] = {
    PointField.INT8: np.dtype(np.int8),
    PointField.UINT8: np.dtype(np.uint8),
    PointField.INT16: np.dtype(np.int16),
    PointField.UINT16: np.dtype(np.uint16),
    PointField.INT32: np.dtype(np.int32),
    PointField.UINT32: np.dtype(np.uint32),
    PointField.FLOAT32: np.dtype(np.float32),
    PointField.FLOAT64: np.dtype(np.float64),
}
_XYZ = tuple(
    PointField(name=name, offset=4 * index, datatype=PointField.FLOAT32, count=1)
    for index, name in enumerate('xyz')
)


def read_points(
    cloud: PointCloud2,
    field_names: list[str] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[Any] | None = None,
    reshape_organized_cloud: bool = False,
) -> np.ndarray:
    """
    Read the points of a cloud as a structured array.

    Parameters
    ----------
    cloud
        The message.
    field_names
        The fields to read, such as `['x', 'y', 'z']`; None for all.
    skip_nans
        Whether to leave out points with NaN in one of these fields.
    uvs
        The points to read: their indices or, for an organized cloud, pairs (u, v) of column and
        row. None for all.
    reshape_organized_cloud
        Whether to return an organized cloud as an array of (width, height); not together with
        `skip_nans` or `uvs`.

    Returns
    -------
    numpy.ndarray
        The points, with the fields of the message by name.

    Raises
    ------
    ValueError
        The cloud does not have such fields or points, or a selection cannot be reshaped.

    """
    points = _all_points(cloud)
    if field_names is not None:
        points = points[_known(field_names, points.dtype)]
    if reshape_organized_cloud and (skip_nans or uvs is not None):
        raise ValueError('A part of a cloud cannot be reshaped: leave out skip_nans and uvs')
    if uvs is not None:
        points = points[_indices(cloud, uvs)]
    if skip_nans and not cloud.is_dense:
        points = points[~_has_nan(points)]
    if reshape_organized_cloud and cloud.height > 1:
        points = points.reshape(cloud.width, cloud.height)
    return points


def read_points_numpy(
    cloud: PointCloud2,
    field_names: list[str] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[Any] | None = None,
    reshape_organized_cloud: bool = False,
) -> np.ndarray:
    """
    Read the points of a cloud as an array of numbers, with the fields along the last axis.

    Parameters
    ----------
    cloud, field_names, skip_nans, uvs, reshape_organized_cloud
        As for `read_points`.

    Returns
    -------
    numpy.ndarray
        The points: (N, fields), or (width, height, fields) if reshaped.

    Raises
    ------
    ValueError
        The fields do not have all the same type, or as for `read_points`.

    """
    fields = cloud.fields
    if field_names is not None:
        fields = [field for field in fields if field.name in field_names]
    if len({field.datatype for field in fields}) > 1:
        types = ', '.join(f'{field.name}: {_TYPES[field.datatype]}' for field in fields)
        raise ValueError(
            f'An array of numbers needs fields of one type, these are of several ({types}): '
            'choose some with field_names, or use read_points'
        )
    points = read_points(cloud, field_names, skip_nans, uvs, reshape_organized_cloud)
    return structured_to_unstructured(points)


def read_points_list(
    cloud: PointCloud2,
    field_names: list[str] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[Any] | None = None,
) -> list[Any]:
    """
    Read the points of a cloud as named tuples; slow for large clouds.

    Parameters
    ----------
    cloud, field_names, skip_nans, uvs
        As for `read_points`.

    Returns
    -------
    list of Point
        Tuples with the fields as attributes.

    Raises
    ------
    ValueError
        As for `read_points`.

    """
    points = read_points(cloud, field_names, skip_nans, uvs)
    point = namedtuple('Point', list(points.dtype.names or ()))  # type: ignore[misc]
    return [point._make(row) for row in points.tolist()]


def dtype_from_fields(fields: Iterable[PointField], point_step: int | None = None) -> np.dtype:
    """
    Make the type of a structured array from the fields of a cloud.

    Parameters
    ----------
    fields
        The fields. A field of several elements becomes `name_0`, `name_1` ...; one without a name
        is called after its place.
    point_step
        The size of a point in bytes; by default the fields end it.

    Returns
    -------
    numpy.dtype
        The type, with the fields at their offsets.

    """
    names, offsets, formats = [], [], []
    for index, field in enumerate(fields):
        kind = _TYPES[field.datatype]
        name = field.name or f'{DUMMY_FIELD_PREFIX}_{index}'
        for element in range(max(1, field.count)):
            names.append(name if field.count <= 1 else f'{name}_{element}')
            offsets.append(field.offset + element * kind.itemsize)
            formats.append(kind)
    layout: Any = {'names': names, 'offsets': offsets, 'formats': formats}
    if point_step is not None:
        layout['itemsize'] = point_step
    whole: np.dtype = np.dtype(layout)
    return whole


def create_cloud(
    header: Header,
    fields: Iterable[PointField],
    points: Iterable[Any],
    point_step: int | None = None,
) -> PointCloud2:
    """
    Make a cloud with any fields.

    Parameters
    ----------
    header
        The header of the message.
    fields
        The fields.
    points
        The points: a structured array of the type of these fields, an array of numbers with the
        fields along the last axis, or an iterable of iterables with one number for each field.
        Arrays of (width, height) points make organized clouds.
    point_step
        The size of a point in bytes; by default the fields end it.

    Returns
    -------
    PointCloud2
        The message.

    Raises
    ------
    ValueError
        The points do not have as many numbers as there are fields.

    """
    fields = list(fields)
    kind = dtype_from_fields(fields, point_step)
    cells = points if isinstance(points, np.ndarray) else np.array([*map(tuple, points)], kind)
    if cells.dtype.names is None:
        if cells.shape[-1] != len(kind.names or ()):
            raise ValueError(
                f'The points have {cells.shape[-1]} numbers each, but there are '
                f'{len(kind.names or ())} fields ({", ".join(kind.names or ())})'
            )
        cells = unstructured_to_structured(cells, kind)
    elif cells.dtype != kind:
        cells = cells[list(kind.names or ())].astype(kind)
    width, height = cells.shape if cells.ndim == 2 else (cells.size, 1)
    cloud = PointCloud2(
        header=header,
        height=height,
        width=width,
        fields=fields,
        is_bigendian=sys.byteorder != 'little',
        is_dense=False,
        point_step=kind.itemsize,
        row_step=kind.itemsize * width,
    )
    cloud.data = _bytes(cells)
    return cloud


def create_cloud_xyz32(header: Header, points: Iterable[Any]) -> PointCloud2:
    """
    Make a cloud of points with the coordinates x, y and z in single precision.

    Parameters
    ----------
    header
        The header of the message.
    points
        The points, as for `create_cloud`, in m.

    Returns
    -------
    PointCloud2
        The message.

    """
    return create_cloud(header, _XYZ, points)


def _all_points(cloud: PointCloud2) -> np.ndarray:
    """Return a copy of all points of a message, without the padding of rows."""
    kind = dtype_from_fields(cloud.fields, cloud.point_step)
    if bool(cloud.is_bigendian) != (sys.byteorder != 'little'):
        kind = kind.newbyteorder()
    strides = (cloud.row_step or cloud.width * cloud.point_step, cloud.point_step)
    if not cloud.width * cloud.height:
        return np.empty(0, kind)
    rows: np.ndarray = np.ndarray(
        (cloud.height, cloud.width), kind, bytearray(cloud.data), strides=strides
    )
    return rows.reshape(-1)


def _known(names: Iterable[str], kind: np.dtype) -> list[str]:
    names = list(names)
    unknown = [name for name in names if name not in (kind.names or ())]
    if unknown:
        raise ValueError(
            f'The cloud has no field {", ".join(map(repr, unknown))}; it has '
            f'{", ".join(map(repr, kind.names or ()))}'
        )
    return names


def _indices(cloud: PointCloud2, uvs: Iterable[Any]) -> np.ndarray:
    """Return indices of points, from indices or pairs of column and row."""
    places = np.asarray(uvs if isinstance(uvs, np.ndarray) else list(uvs), np.int64)
    if places.ndim == 2:
        places = places[:, 1] * cloud.width + places[:, 0]
    count = cloud.width * cloud.height
    if places.size and not 0 <= places.min() <= places.max() < count:
        raise ValueError(f'uvs asks for points outside the cloud, which has {count} points')
    return places


def _has_nan(points: np.ndarray) -> np.ndarray:
    found = np.zeros(points.shape, bool)
    for name in points.dtype.names or ():
        found |= np.isnan(points[name])
    return found


def _bytes(points: np.ndarray) -> Any:
    """Return the memory of an array in the type that messages store without a check of each."""
    data = array.array('B')
    data.frombytes(np.ascontiguousarray(points).tobytes())
    return data
