# SPDX-License-Identifier: Apache-2.0
"""How messages of laser scanners and point clouds are decoded to points, and coloured."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rviz_default_plugins.decoding.geometry import FARTHEST, Points

__all__ = [
    'Cloud',
    'Colors',
    'Scale',
    'colors_rgb8',
    'colors_rgbf32',
    'decode_cloud',
    'decode_scan',
    'rainbow',
]

# The types for the constants in PointField.datatype.
KINDS = {1: 'i1', 2: 'u1', 3: 'i2', 4: 'u2', 5: 'i4', 6: 'u4', 7: 'f4', 8: 'f8'}


@dataclass(frozen=True)
class Cloud:
    """Points as rows x, y and z in metres; each channel has one value per point."""

    points: Points
    channels: dict[str, NDArray[Any]] = field(default_factory=dict)

    def __len__(self) -> int:
        """Return the number of points."""
        return len(self.points)

    def __getitem__(self, chosen: Any) -> Cloud:
        """Return a subset of the points."""
        channels = {name: values[chosen] for name, values in self.channels.items()}
        return Cloud(self.points[chosen], channels)

    def finite(self) -> Cloud:
        """Return the points with finite coordinates within `FARTHEST`."""
        somewhere = (np.abs(self.points) <= FARTHEST).all(axis=1)
        return self if somewhere.all() else self[somewhere]

    def thinned(self, most: int) -> Cloud:
        """
        Downsample the cloud: keep every n-th point.

        Parameters
        ----------
        most
            The maximum number of points to keep.

        """
        step = -(-len(self) // most)
        return self[::step] if step > 1 else self


def decode_scan(message: Any) -> Cloud:
    """
    Convert `sensor_msgs/msg/LaserScan` to points.

    Parameters
    ----------
    message
        The message.

    Returns
    -------
    Cloud
        The ranges from `range_min` to `range_max`, as points in the frame of the scanner, in m;
        with a channel `intensity` if there is one for each range.

    Raises
    ------
    ValueError
        The first angle or the angle increment is not finite.

    """
    if not (math.isfinite(message.angle_min) and math.isfinite(message.angle_increment)):
        raise ValueError('its angles are not finite.')
    ranges = np.asarray(message.ranges, dtype=np.float64)
    angles = message.angle_min + np.arange(len(ranges)) * message.angle_increment
    hit = np.isfinite(ranges) & (ranges >= message.range_min) & (ranges <= message.range_max)
    reach, angles = ranges[hit], angles[hit]
    points = np.stack(
        [reach * np.cos(angles), reach * np.sin(angles), np.zeros_like(reach)], axis=1
    )
    return Cloud(points.astype(np.float32), _intensities(message, len(ranges), hit))


def _intensities(message: Any, count: int, hit: Any) -> dict[str, Any]:
    """Return the channel of intensities, if there is one for each range."""
    intensities = np.asarray(message.intensities, dtype=np.float32)
    return {'intensity': intensities[hit]} if count and len(intensities) == count else {}


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


Colors = NDArray[np.uint8]

# From 0 to 1 in steps of a fifth: magenta, blue, cyan, green, yellow, red.
_STOPS = np.linspace(0.0, 1.0, 6)
_RED = (1.0, 0.0, 0.0, 0.0, 1.0, 1.0)
_GREEN = (0.0, 0.0, 1.0, 1.0, 1.0, 0.0)
_BLUE = (1.0, 1.0, 1.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Scale:
    """Colour map of values between two limits; by default their minimum and maximum."""

    minimum: float | None = None
    maximum: float | None = None
    is_rainbow: bool = True
    is_inverted: bool = False
    colors: tuple[Sequence[int], Sequence[int]] = ((0, 0, 0), (255, 255, 255))

    def paint(self, values: NDArray[Any]) -> Colors:
        """
        Map values to colours.

        Parameters
        ----------
        values
            A number for each of N points; NaN counts as the minimum.

        Returns
        -------
        Colors
            Red, green and blue (N, 3).

        """
        parts = self._parts(np.asarray(values, dtype=np.float64))
        if self.is_rainbow:
            return rainbow(parts if self.is_inverted else 1.0 - parts)
        low, high = (np.asarray(end, dtype=np.float64) for end in self.colors)
        colors: Colors = (low + parts[:, None] * (high - low)).round().astype(np.uint8)
        return colors

    def _parts(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Normalise the values between the limits to the range from 0 to 1."""
        known = values[np.isfinite(values)]
        low = self._limit(self.minimum, known, np.min)
        high = self._limit(self.maximum, known, np.max)
        span = high - low
        if span == 0.0:
            return np.zeros_like(values)
        with np.errstate(invalid='ignore'):
            parts = np.clip((values - low) / span, 0.0, 1.0)
        return np.nan_to_num(parts, nan=0.0)

    @staticmethod
    def _limit(given: float | None, known: NDArray[np.float64], find: Any) -> float:
        if given is not None:
            return given
        return float(find(known)) if known.size else 0.0


def rainbow(parts: NDArray[np.float64]) -> Colors:
    """
    Map numbers to the colours of the rainbow, from magenta at 0 to red at 1.

    Parameters
    ----------
    parts
        N numbers from 0 to 1.

    Returns
    -------
    Colors
        Red, green and blue (N, 3).

    """
    channels = [np.interp(parts, _STOPS, stops) for stops in (_RED, _GREEN, _BLUE)]
    colors: Colors = (np.stack(channels, axis=-1) * 255.0).round().astype(np.uint8)
    return colors


def colors_rgb8(cloud: Cloud) -> Colors | None:
    """
    Unpack the colours of the field `rgb` or `rgba`, which packs them as bytes of a number.

    Parameters
    ----------
    cloud
        A cloud of N points.

    Returns
    -------
    Colors | None
        Red, green and blue (N, 3); None without such a field of 32 bits.

    """
    packed = cloud.channels.get('rgb', cloud.channels.get('rgba'))
    if packed is None or packed.dtype.itemsize != 4:
        return None
    native = np.ascontiguousarray(packed.astype(packed.dtype.newbyteorder('=')))
    whole = native.view(np.uint32)
    return np.stack([whole >> 16 & 255, whole >> 8 & 255, whole & 255], axis=1).astype(np.uint8)


def colors_rgbf32(cloud: Cloud) -> Colors | None:
    """
    Convert the colours of the fields `r`, `g` and `b`, which are numbers from 0 to 1.

    Parameters
    ----------
    cloud
        A cloud of N points.

    Returns
    -------
    Colors | None
        Red, green and blue (N, 3); None if one of the fields is missing.

    """
    if not all(name in cloud.channels for name in 'rgb'):
        return None
    parts = np.stack([cloud.channels[name].astype(np.float64) for name in 'rgb'], axis=1)
    colors: Colors = (np.clip(np.nan_to_num(parts), 0.0, 1.0) * 255.0).round().astype(np.uint8)
    return colors
