# SPDX-License-Identifier: Apache-2.0
"""The points of `sensor_msgs/msg/PointCloud2`."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from rviz_default_plugins.decoding.cloud import Cloud

__all__ = ['decode_cloud']

# The types for the constants in PointField.datatype.
KINDS = {1: 'i1', 2: 'u1', 3: 'i2', 4: 'u2', 5: 'i4', 6: 'u4', 7: 'f4', 8: 'f8'}


def decode_cloud(message: Any) -> Cloud:
    """
    Convert `sensor_msgs/msg/PointCloud2` to points with channels.

    A field of several values per point becomes a channel with the first of them.

    Parameters
    ----------
    message
        The message.

    Returns
    -------
    Cloud
        The points in the frame of the message, in m; all fields except x, y, z are channels.

    Raises
    ------
    ValueError
        A field x, y or z is missing, a field is invalid, or the data is too short.

    """
    data = _records(message)
    missing = [axis for axis in 'xyz' if axis not in (data.dtype.names or ())]
    if missing:
        raise ValueError(
            f'it has no field {missing[0]}; its fields are '
            f'{", ".join(data.dtype.names or ()) or "none"}.'
        )
    with np.errstate(over='ignore', invalid='ignore'):  # overflows: dropped later
        points = np.stack([data[axis].astype(np.float32) for axis in 'xyz'], axis=1)
    names = [name for name in data.dtype.names or () if name not in 'xyz']
    return Cloud(points, {name: data[name] for name in names})


def _records(message: Any) -> NDArray[Any]:
    """View the data as one record per point."""
    kind = _record_type(message)
    width, height, row = message.width, message.height, message.row_step
    data = np.frombuffer(message.data, dtype=np.uint8)
    used = width * message.point_step
    if width * height == 0:
        return np.empty(0, dtype=kind)
    if height == 1 and row < used:
        row = used  # many publishers of a single row do not set its length
    if row < used:
        raise ValueError(
            f'its rows of {row} bytes are too short for {width} points of '
            f'{message.point_step} bytes.'
        )
    needed = row * (height - 1) + used
    if len(data) < needed:
        raise ValueError(
            f'it has {len(data)} bytes of data, but {width} x {height} points need {needed}.'
        )
    records: NDArray[Any] = np.ndarray(
        (height, width), dtype=kind, buffer=data, strides=(row, message.point_step)
    )
    return records.reshape(-1)


def _record_type(message: Any) -> np.dtype[Any]:
    """Return the structured data type of a point."""
    order = '>' if message.is_bigendian else '<'
    names, formats, offsets = [], [], []
    for each in message.fields:
        kind = KINDS.get(each.datatype)
        if kind is None:
            raise ValueError(f"its field '{each.name}' has the unknown type {each.datatype}.")
        size = int(kind[1])
        if each.offset + size > message.point_step:
            raise ValueError(
                f"its field '{each.name}' ends at byte {each.offset + size} of a point, which has "
                f'only {message.point_step}.'
            )
        if each.name in names or not each.name:
            continue
        names.append(each.name)
        formats.append(order + kind)
        offsets.append(each.offset)
    return np.dtype(
        {'names': names, 'formats': formats, 'offsets': offsets, 'itemsize': message.point_step}
    )
