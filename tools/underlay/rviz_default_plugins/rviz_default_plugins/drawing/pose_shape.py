# SPDX-License-Identifier: Apache-2.0
"""The arrow or the axes that show a pose, and their properties."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rviz_common.canvas import Canvas
from rviz_common.properties import Choice, ColorOf, Flag, Number, Property, Values
from rviz_default_plugins.decoding.covariance import ellipsoid_of
from rviz_default_plugins.decoding.geometry import position, rotation
from rviz_default_plugins.drawing.bodies import add_ellipsoid, add_surface
from rviz_default_plugins.drawing.surfaces import arrow

__all__ = ['COVARIANCE', 'add_covariance', 'add_pose', 'pose_shape_properties']

COVARIANCE = (
    Flag('Covariance/Value', True, 'Whether it is shown how uncertain the pose is.'),
    Flag('Covariance/Position/Value', True, 'Whether it is shown for the position.'),
    ColorOf('Covariance/Position/Color', (204, 51, 204), 'Colour of the ellipsoid.'),
    Number('Covariance/Position/Alpha', 0.3, '0 is transparent.', 0.0, 1.0),
    Number('Covariance/Position/Scale', 1.0, 'Standard deviations as radius.', 0.0),
)


def pose_shape_properties(shape: str, below: str = '') -> tuple[Property, ...]:
    """
    Define the properties of the arrow or the axes that show a pose.

    Parameters
    ----------
    shape
        The path of the property that chooses between the two.
    below
        The prefix of the paths of the others, such as `Shape/`.

    """
    return (
        Choice(shape, 'Arrow', 'What shows a pose.', ('Arrow', 'Axes')),
        Number(f'{below}Alpha', 1.0, '0 is transparent.', 0.0, 1.0),
        ColorOf(f'{below}Color', (255, 25, 0), 'Colour of the arrow.'),
        Number(f'{below}Shaft Length', 1.0, 'Length of the shaft, in metres.', 0.0),
        Number(f'{below}Shaft Radius', 0.05, 'Radius of the shaft, in metres.', 0.0),
        Number(f'{below}Head Length', 0.3, 'Length of the head, in metres.', 0.0),
        Number(f'{below}Head Radius', 0.1, 'Radius of the head, in metres.', 0.0),
        Number(f'{below}Axes Length', 1.0, 'Length of the axes, in metres.', 0.0),
        Number(f'{below}Axes Radius', 0.1, 'Radius of the axes, in metres.', 0.0),
    )


def add_pose(canvas: Canvas, pose: Any, values: Values, shape: str, below: str = '') -> None:
    """
    Draw the arrow or the axes of a pose.

    Parameters
    ----------
    canvas
        Where to draw.
    pose
        The message, of the type `geometry_msgs/msg/Pose`.
    values
        The values of the properties.
    shape, below
        As for `pose_shape_properties`.

    Raises
    ------
    ValueError
        The position or the orientation is invalid.

    """
    at, turn = position(pose.position), rotation(pose.orientation)
    if values[shape] == 'Axes':
        canvas.put(
            'frame',
            'axes',
            axes_length=values[f'{below}Axes Length'],
            axes_radius=values[f'{below}Axes Radius'],
            origin_radius=values[f'{below}Axes Radius'],
            position=at,
            wxyz=turn,
        )
        return
    names: Sequence[str] = ('Shaft Length', 'Shaft Radius', 'Head Length', 'Head Radius')
    surface = arrow(*(values[f'{below}{name}'] for name in names))
    paint = values[f'{below}Color'], values[f'{below}Alpha']
    add_surface(canvas, 'arrow', surface, paint, position=at, wxyz=turn)


def add_covariance(canvas: Canvas, pose: Any, values: Values) -> None:
    """
    Draw the ellipsoid of the position covariance, if it is enabled.

    Parameters
    ----------
    canvas
        Where to draw.
    pose
        The message, of the type `geometry_msgs/msg/PoseWithCovariance`.
    values
        The values of the properties, among them those of `COVARIANCE`.

    Raises
    ------
    ValueError
        The covariance or the position is invalid.

    """
    if not (values['Covariance/Value'] and values['Covariance/Position/Value']):
        return
    paint = values['Covariance/Position/Color'], values['Covariance/Position/Alpha']
    add_ellipsoid(
        canvas,
        'covariance',
        ellipsoid_of(pose.covariance),
        paint,
        position(pose.pose.position),
        values['Covariance/Position/Scale'],
    )
