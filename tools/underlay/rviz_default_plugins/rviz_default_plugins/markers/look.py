# SPDX-License-Identifier: Apache-2.0
"""The look of a marker, independent of its pose."""

from __future__ import annotations

from dataclasses import dataclass
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rviz_default_plugins.decoding.geometry import finite_points_of, Points, position, Triple
from visualization_msgs.msg import Marker

__all__ = ['Look', 'look_of']

MOST = 200_000
"""The maximum number of points of a marker that are shown."""

# The number of points that belong together and are only dropped together.
GROUPS = {Marker.LINE_LIST: 2, Marker.TRIANGLE_LIST: 3}

Colors = NDArray[np.uint8]


@dataclass(frozen=True)
class Look:
    """
    The validated look of a marker.

    Colours are from 0 to 255; there is one for each point, or each triangle, or none. `note` is
    a remark for the user, such as on points that were left out.
    """

    kind: int
    scale: Triple
    color: tuple[int, int, int]
    alpha: float
    points: Points
    colors: Colors | None
    alphas: NDArray[np.float32] | None
    text: str
    mesh: tuple[str, bool]
    note: str = ''

    def is_like(self, other: Look | None) -> bool:
        """
        Whether another look is the same, so that nothing has to be redrawn.

        Parameters
        ----------
        other
            The look that is drawn now, None for nothing.

        """
        return other is not None and self.plain == other.plain and self._same_points(other)

    @property
    def plain(self) -> tuple[Any, ...]:
        """Return all that is neither an array nor the note."""
        return self.kind, self.scale, self.color, self.alpha, self.text, self.mesh

    def _same_points(self, other: Look) -> bool:
        return (
            np.array_equal(self.points, other.points)
            and _same(self.colors, other.colors)
            and _same(self.alphas, other.alphas)
        )


def look_of(marker: Any) -> Look:
    """
    Validate a marker, and extract its look.

    Parameters
    ----------
    marker
        The message, of the type `visualization_msgs/msg/Marker`.

    Raises
    ------
    ValueError
        The colour, the scale, the points or the number of colours are invalid.

    """
    color, alpha = _color(marker.color)
    points, colors, note = _points(marker)
    is_colored = colors is not None
    if not is_colored and alpha == 0.0:
        note = 'it is transparent, since its color has a=0.'
    return Look(
        marker.type,
        position(marker.scale, 'scale'),
        color,
        alpha,
        points,
        None if colors is None else _bytes(colors[:, :3]),
        None if colors is None else colors[:, 3],
        marker.text if marker.type == Marker.TEXT_VIEW_FACING else '',
        (marker.mesh_resource, bool(marker.mesh_use_embedded_materials)),
        note,
    )


def _color(color: Any) -> tuple[tuple[int, int, int], float]:
    parts = (color.r, color.g, color.b, color.a)
    if not all(map(math.isfinite, parts)):
        raise ValueError('its color has numbers that are not finite.')
    red, green, blue, alpha = (min(1.0, max(0.0, part)) for part in parts)
    return (round(red * 255), round(green * 255), round(blue * 255)), alpha


def _points(marker: Any) -> tuple[Points, NDArray[np.float32] | None, str]:
    """Return points and colours, downsampled in whole groups, and a note on that."""
    count, colors = len(marker.points), len(marker.colors)
    group = GROUPS.get(marker.type, 1)
    if count % group:
        raise ValueError(f'it has {count} points, which is not a multiple of {group}.')
    allowed = {0, count, count // 3} if group == 3 else {0, count}
    if colors not in allowed:
        raise ValueError(f'it has {count} points, but {colors} colors.')
    step = max(1, -(-count // MOST))
    per_color = group if colors == count else 1
    points = finite_points_of(_each(marker.points, group, step))
    note = f'{len(points)} of its {count} points are shown.' if step > 1 else ''
    return points, _colors(_each(marker.colors, per_color, step)), note


def _each(values: Any, group: int, step: int) -> Any:
    """Return every n-th group of values."""
    if step == 1:
        return values
    starts = range(0, len(values), group * step)
    return [value for start in starts for value in values[slice(start, start + group)]]


def _colors(colors: Any) -> NDArray[np.float32] | None:
    if not colors:
        return None
    flat = [part for each in colors for part in (each.r, each.g, each.b, each.a)]
    parts = np.nan_to_num(np.array(flat, dtype=np.float64).reshape(-1, 4))
    return np.clip(parts, 0.0, 1.0).astype(np.float32)


def _bytes(parts: NDArray[np.float32]) -> Colors:
    colors: Colors = (parts * 255.0).round().astype(np.uint8)
    return colors


def _same(first: Any, second: Any) -> bool:
    if first is None or second is None:
        return first is second
    return np.array_equal(first, second)
