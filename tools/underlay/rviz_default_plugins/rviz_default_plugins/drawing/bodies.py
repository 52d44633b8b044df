# SPDX-License-Identifier: Apache-2.0
"""Add arrows and other bodies to a scene."""

from __future__ import annotations

from collections.abc import Sequence
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rviz_common.canvas import Canvas
from rviz_default_plugins.decoding.covariance import Ellipsoid
from rviz_default_plugins.decoding.geometry import along_x, Triple
from rviz_default_plugins.drawing.surfaces import arrow, Surface

__all__ = [
    'Paint',
    'add_arrow_to',
    'add_copies',
    'add_ellipsoid',
    'add_lines',
    'add_surface',
    'opacity_of',
]

Paint = tuple[Sequence[int], float]
"""Red, green and blue from 0 to 255, and alpha from 0 to 1."""


def opacity_of(alpha: float) -> float | None:
    """Return what viser wants; what is not transparent at all is drawn faster."""
    return None if alpha >= 1.0 else max(0.0, alpha)


def add_surface(canvas: Canvas, name: str, surface: Surface, paint: Paint, **options: Any) -> None:
    """Add a body of one colour; options are those of `add_mesh_simple`."""
    color, alpha = paint
    canvas.put(
        'mesh_simple',
        name,
        vertices=surface.vertices,
        faces=surface.faces,
        color=tuple(int(part) for part in color),
        opacity=opacity_of(alpha),
        flat_shading=True,
        **options,
    )


def add_copies(
    canvas: Canvas,
    name: str,
    surface: Surface,
    paint: Paint,
    positions: NDArray[Any],
    wxyzs: NDArray[Any] | None = None,
    **options: Any,
) -> None:
    """Add a body at each of some places; options are those of `add_batched_meshes_simple`."""
    color, alpha = paint
    if wxyzs is None:
        wxyzs = np.tile(np.array([1.0, 0.0, 0.0, 0.0], np.float32), (len(positions), 1))
    options.setdefault('batched_colors', tuple(int(part) for part in color))
    canvas.put(
        'batched_meshes_simple',
        name,
        vertices=surface.vertices,
        faces=surface.faces,
        batched_wxyzs=wxyzs,
        batched_positions=positions,
        opacity=opacity_of(alpha),
        lod='off',
        flat_shading=True,
        **options,
    )


def add_arrow_to(
    canvas: Canvas, name: str, vector: Triple, width: float, paint: Paint, start: Triple
) -> None:
    """Add an arrow from a point along a vector, which is as long; nothing for zero."""
    length = math.hypot(*vector)
    if length < 1e-9:
        return
    head = min(0.3 * length, 3.0 * width)
    surface = arrow(length - head, 0.5 * width, head, width)
    add_surface(canvas, name, surface, paint, position=start, wxyz=along_x(vector))


def add_ellipsoid(
    canvas: Canvas, name: str, ellipsoid: Ellipsoid, paint: Paint, position: Triple, scale: float
) -> None:
    """Add what shows how uncertain a position is."""
    color, alpha = paint
    canvas.put(
        'icosphere',
        name,
        radius=1.0,
        color=tuple(color),
        opacity=opacity_of(alpha),
        scale=tuple(max(radius * scale, 1e-3) for radius in ellipsoid.radii),
        position=position,
        wxyz=ellipsoid.wxyz,
    )


def add_lines(
    canvas: Canvas,
    name: str,
    segments: NDArray[Any],
    colors: Any,
    width: float | None = None,
    **options: Any,
) -> None:
    """Add lines, N x 2 points, of a width in metres, or else as thin as seen well."""
    canvas.put(
        'line_segments',
        name,
        points=segments,
        colors=colors,
        thickness=2.0 if width is None else width,
        thickness_units='screen' if width is None else 'world',
        **options,
    )
