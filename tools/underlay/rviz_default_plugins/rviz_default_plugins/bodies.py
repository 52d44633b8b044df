# SPDX-License-Identifier: Apache-2.0
"""How arrows, lines and other bodies are drawn, and which triangle meshes they have."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from rviz_common.canvas import Canvas
from rviz_default_plugins.decoding.geometry import along_x, Triple

__all__ = [
    'HIGHLIGHT_COLOR',
    'Paint',
    'Surface',
    'add_arrow_to',
    'add_copies',
    'add_lines',
    'add_surface',
    'arrow',
    'cone',
    'cube',
    'opacity_of',
    'revolved',
    'sphere',
]

Paint = tuple[Sequence[int], float]
"""Red, green and blue from 0 to 255, and alpha from 0 to 1."""

HIGHLIGHT_COLOR = (1.0, 0.8, 0.1, 0.55)
"""Red, green, blue and opacity of what covers a selected object, from 0 to 1."""


class Surface(NamedTuple):
    """Vertices in metres, and the indices of those of each triangle."""

    vertices: NDArray[Any]
    faces: NDArray[Any]


def revolved(profile: Sequence[tuple[float, float]], segments: int = 12) -> Surface:
    """
    Make the surface of revolution of a profile about the x axis.

    Parameters
    ----------
    profile
        Pairs of x and radius, in m, in order of increasing x.
    segments
        The number of vertices around the axis for each pair.

    """
    turns = np.linspace(0.0, 2.0 * np.pi, segments, endpoint=False)
    rings = [
        np.stack([np.full(segments, x), radius * np.cos(turns), radius * np.sin(turns)], axis=1)
        for x, radius in profile
    ]
    here = np.arange(segments)
    beside = (here + 1) % segments
    faces = []
    for ring in range(len(profile) - 1):
        low, high = ring * segments, (ring + 1) * segments
        faces.append(np.stack([low + here, low + beside, high + here], axis=1))
        faces.append(np.stack([low + beside, high + beside, high + here], axis=1))
    return Surface(
        np.concatenate(rings).astype(np.float32), np.concatenate(faces).astype(np.uint32)
    )


@lru_cache(maxsize=64)
def arrow(
    shaft_length: float, shaft_radius: float, head_length: float, head_radius: float
) -> Surface:
    """
    Make an arrow along the x axis, whose tail is at the origin.

    Parameters
    ----------
    shaft_length, shaft_radius
        The size of the shaft, in m.
    head_length, head_radius
        The size of the head, which is a cone, in m.

    """
    end = shaft_length + head_length
    return revolved(
        (
            (0.0, 0.0),
            (0.0, shaft_radius),
            (shaft_length, shaft_radius),
            (shaft_length, head_radius),
            (end, 0.0),
        )
    )


@lru_cache(maxsize=64)
def cone(length: float, radius: float) -> Surface:
    """
    Make a cone with its tip at the origin that opens along the x axis.

    Parameters
    ----------
    length
        From the tip to the base, in m.
    radius
        The radius of the base, in m.

    """
    return revolved(((0.0, 0.0), (length, radius), (length, 0.0)), 24)


@lru_cache(maxsize=64)
def sphere(rings: int = 8) -> Surface:
    """
    Make a sphere of diameter 1 around the origin.

    Parameters
    ----------
    rings
        The number of rings of faces along the x axis.

    """
    angles = np.linspace(0.0, np.pi, rings + 1)
    return revolved([(-0.5 * float(np.cos(a)), 0.5 * float(np.sin(a))) for a in angles])


@lru_cache(maxsize=64)
def cube() -> Surface:
    """Make a cube with edges of length 1 around the origin."""
    corners = [(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]
    squares = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    faces = [face for a, b, c, d in squares for face in ((a, b, c), (a, c, d))]
    return Surface(np.array(corners, dtype=np.float32), np.array(faces, dtype=np.uint32))


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
