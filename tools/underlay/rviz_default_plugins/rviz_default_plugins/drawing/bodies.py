# SPDX-License-Identifier: Apache-2.0
"""Drawing of arrows and other bodies."""

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
    """
    Convert alpha to the opacity of viser, where None, for opaque, is drawn faster than 1.

    Parameters
    ----------
    alpha
        From 0, transparent, to 1, opaque; it is clamped to this range.

    """
    return None if alpha >= 1.0 else max(0.0, alpha)


def add_surface(canvas: Canvas, name: str, surface: Surface, paint: Paint, **options: Any) -> None:
    """
    Draw a triangle mesh of one colour.

    Parameters
    ----------
    canvas
        Where to draw.
    name
        The name of the node, below the root of the canvas.
    surface
        The mesh.
    paint
        The colour and alpha.
    **options
        Other arguments of `add_mesh_simple` of viser, such as `position` and `wxyz`.

    """
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
    """
    Draw copies of a triangle mesh, as one node of the scene.

    Parameters
    ----------
    canvas
        Where to draw.
    name
        The name of the node, below the root of the canvas.
    surface
        The mesh.
    paint
        The colour and alpha of all copies.
    positions
        The positions of the copies (N, 3), in m.
    wxyzs
        Their rotations as rows w, x, y and z (N, 4); by default none is rotated.
    **options
        Other arguments of `add_batched_meshes_simple` of viser, such as `batched_colors`.

    """
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
    """
    Draw a vector as an arrow; nothing for the zero vector.

    Parameters
    ----------
    canvas
        Where to draw.
    name
        The name of the node, below the root of the canvas.
    vector
        From the tail to the tip, in m.
    width
        The diameter of the shaft, in m; that of the head is twice as large.
    paint
        The colour and alpha.
    start
        The position of the tail, in m.

    """
    length = math.hypot(*vector)
    if length < 1e-9:
        return
    head = min(0.3 * length, 3.0 * width)
    surface = arrow(length - head, 0.5 * width, head, width)
    add_surface(canvas, name, surface, paint, position=start, wxyz=along_x(vector))


def add_ellipsoid(
    canvas: Canvas, name: str, ellipsoid: Ellipsoid, paint: Paint, position: Triple, scale: float
) -> None:
    """
    Draw the covariance ellipsoid of a position.

    Parameters
    ----------
    canvas
        Where to draw.
    name
        The name of the node, below the root of the canvas.
    ellipsoid
        One standard deviation along each axis.
    paint
        The colour and alpha.
    position
        The centre, in m.
    scale
        The length of the semi-axes in standard deviations; they are at least 1 mm long.

    """
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
    """
    Draw separate lines, as one node of the scene.

    Parameters
    ----------
    canvas
        Where to draw.
    name
        The name of the node, below the root of the canvas.
    segments
        The ends of N lines (N, 2, 3), in m.
    colors
        One colour for all lines, or one for each end (N, 2, 3); red, green and blue from 0 to 255.
    width
        In m; None for 2 pixels on the screen.
    **options
        Other arguments of `add_line_segments` of viser, such as `wxyz`.

    """
    canvas.put(
        'line_segments',
        name,
        points=segments,
        colors=colors,
        thickness=2.0 if width is None else width,
        thickness_units='screen' if width is None else 'world',
        **options,
    )
