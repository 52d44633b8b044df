# SPDX-License-Identifier: Apache-2.0
"""Drawing of markers by type."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from rviz_common.canvas import Canvas
from rviz_common.glb import glb_of
from rviz_default_plugins.bodies import (
    add_copies,
    add_lines,
    add_surface,
    arrow,
    cube,
    opacity_of,
    Paint,
    sphere,
    Surface,
)
from rviz_default_plugins.decoding.geometry import along_x, Points
from rviz_default_plugins.markers.look import Look
from rviz_default_plugins.markers.mesh import draw_mesh
from visualization_msgs.msg import Marker

__all__ = ['draw_look']

ARROW = arrow(0.77, 0.25, 0.23, 0.5)
"""An arrow of length and width 1, which the scale of a marker stretches."""
HEAD = 0.23


def draw_look(canvas: Canvas, look: Look) -> None:
    """
    Draw a marker of any type.

    Parameters
    ----------
    canvas
        Where to draw, below the node that has the pose of the marker.
    look
        The look of the marker.

    Raises
    ------
    ValueError
        The type is unknown, or the marker is invisible, such as with a scale of zero.
    MeshIsBeingRead
        Its mesh has not been read yet. This is also a ValueError.

    """
    draw = DRAWINGS.get(look.kind)
    if draw is None:
        raise ValueError(f'its type {look.kind} is not known.')
    _check_scale(look)
    if look.alpha or look.colors is not None:
        draw(canvas, 'marker', look)


def _check_scale(look: Look) -> None:
    """Reject a scale that makes the marker invisible."""
    names = SCALES.get(look.kind, 'xyz')
    if look.kind == Marker.ARROW and len(look.points):
        names = 'xy'
    for name, part in zip('xyz', look.scale):
        if name in names and part <= 0.0:
            raise ValueError(f'its scale.{name} is {part:g}, but must be greater than 0.')


def _paint(look: Look) -> Paint:
    return look.color, look.alpha


def _options(look: Look) -> dict[str, Any]:
    return {'color': look.color, 'opacity': opacity_of(look.alpha), 'scale': look.scale}


def _draw_arrow(canvas: Canvas, name: str, look: Look) -> None:
    if len(look.points) not in (0, 2):
        raise ValueError(
            f'it is an arrow with {len(look.points)} points, but must have 2 or none.'
        )
    if not len(look.points):
        add_surface(canvas, name, ARROW, _paint(look), scale=look.scale)
        return
    _draw_arrows_between(canvas, name, look, look.points[:1], look.points[1:])


def _draw_arrow_strip(canvas: Canvas, name: str, look: Look) -> None:
    if len(look.points) < 2:
        raise ValueError('it has fewer than 2 points.')
    _draw_arrows_between(canvas, name, look, look.points[:-1], look.points[1:])


def _draw_arrows_between(
    canvas: Canvas, name: str, look: Look, tails: Points, tips: Points
) -> None:
    shaft, head, head_length = look.scale
    for index, (tail, tip) in enumerate(zip(tails, tips)):
        vector = tip - tail
        length = float(np.linalg.norm(vector))
        if length < 1e-9:
            continue
        of_head = min(head_length or HEAD * length, length)
        surface = arrow(length - of_head, shaft / 2.0, of_head, head / 2.0)
        place = {'position': tuple(map(float, tail)), 'wxyz': along_x(vector)}
        add_surface(canvas, f'{name}_{index}' if index else name, surface, _paint(look), **place)


def _draw_cube(canvas: Canvas, name: str, look: Look) -> None:
    canvas.put('box', name, dimensions=(1.0, 1.0, 1.0), **_options(look))


def _draw_sphere(canvas: Canvas, name: str, look: Look) -> None:
    canvas.put('icosphere', name, radius=0.5, **_options(look))


def _draw_cylinder(canvas: Canvas, name: str, look: Look) -> None:
    canvas.put('cylinder', name, radius=0.5, height=1.0, **_options(look))


def _draw_line_strip(canvas: Canvas, name: str, look: Look) -> None:
    if len(look.points) < 2:
        raise ValueError('it has fewer than 2 points.')
    colors = look.colors
    pairs = None if colors is None else np.stack([colors[:-1], colors[1:]], axis=1)
    _add_lines(canvas, name, look, np.stack([look.points[:-1], look.points[1:]], axis=1), pairs)


def _draw_line_list(canvas: Canvas, name: str, look: Look) -> None:
    colors = None if look.colors is None else look.colors.reshape(-1, 2, 3)
    _add_lines(canvas, name, look, look.points.reshape(-1, 2, 3), colors)


def _add_lines(canvas: Canvas, name: str, look: Look, segments: Points, colors: Any) -> None:
    if len(segments):
        add_lines(canvas, name, segments, look.color if colors is None else colors, look.scale[0])


def _draw_cubes(canvas: Canvas, name: str, look: Look) -> None:
    _draw_copies(canvas, name, look, cube())


def _draw_spheres(canvas: Canvas, name: str, look: Look) -> None:
    _draw_copies(canvas, name, look, sphere())


def _draw_copies(canvas: Canvas, name: str, look: Look, surface: Surface) -> None:
    if not len(look.points):
        return
    options: dict[str, Any] = {}
    paint = _paint(look)
    if look.colors is not None and look.alphas is not None:
        options['batched_colors'] = look.colors
        paint = look.color, 1.0
        if (look.alphas < 1.0).any():
            options['batched_opacities'] = look.alphas
    scaled = Surface(surface.vertices * np.array(look.scale, np.float32), surface.faces)
    add_copies(canvas, name, scaled, paint, look.points, **options)


def _draw_points(canvas: Canvas, name: str, look: Look) -> None:
    if len(look.points):
        canvas.put(
            'point_cloud',
            name,
            points=look.points,
            colors=look.color if look.colors is None else look.colors,
            precision='float32',
            point_size=look.scale[0],
            point_shape='square',
            point_shading='flat',
        )


def _draw_text(canvas: Canvas, name: str, look: Look) -> None:
    if not look.text:
        raise ValueError('its text is empty.')
    canvas.put(
        'label',
        name,
        text=look.text,
        font_size_mode='scene',
        font_scene_height=look.scale[2],
        anchor='center-center',
    )


def _draw_triangles(canvas: Canvas, name: str, look: Look) -> None:
    if not len(look.points):
        raise ValueError('it has no points.')
    if look.colors is None or look.alphas is None:
        faces = np.arange(len(look.points), dtype=np.uint32).reshape(-1, 3)
        surface = Surface(look.points, faces)
        add_surface(canvas, name, surface, _paint(look), scale=look.scale, side='double')
        return
    colors = np.column_stack([look.colors, (look.alphas * 255.0).astype(np.uint8)])
    if len(colors) != len(look.points):
        colors = np.repeat(colors, 3, axis=0)
    canvas.put('glb', name, glb_data=glb_of(look.points, colors), scale=look.scale)


DRAWINGS: dict[int, Callable[[Canvas, str, Look], None]] = {
    Marker.ARROW: _draw_arrow,
    Marker.CUBE: _draw_cube,
    Marker.SPHERE: _draw_sphere,
    Marker.CYLINDER: _draw_cylinder,
    Marker.LINE_STRIP: _draw_line_strip,
    Marker.LINE_LIST: _draw_line_list,
    Marker.CUBE_LIST: _draw_cubes,
    Marker.SPHERE_LIST: _draw_spheres,
    Marker.POINTS: _draw_points,
    Marker.TEXT_VIEW_FACING: _draw_text,
    Marker.MESH_RESOURCE: draw_mesh,
    Marker.TRIANGLE_LIST: _draw_triangles,
    Marker.ARROW_STRIP: _draw_arrow_strip,
}

SCALES = {
    Marker.LINE_STRIP: 'x',
    Marker.LINE_LIST: 'x',
    Marker.POINTS: 'x',
    Marker.TEXT_VIEW_FACING: 'z',
    Marker.ARROW_STRIP: 'xy',
}
"""The components of the scale that are used, by marker type; all for other types."""
