# SPDX-License-Identifier: Apache-2.0
"""The displays of a pose: an arrow or axes, and the ellipsoid of its covariance."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped
import numpy as np
from rviz_common.canvas import Canvas
from rviz_common.properties import (
    Choice,
    ColorOf,
    Flag,
    Number,
    Property,
    topic_properties,
    Values,
)
from rviz_common.topic_display import MessageDisplay
from rviz_default_plugins.bodies import add_surface, arrow, opacity_of, Paint
from rviz_default_plugins.decoding.geometry import (
    FARTHEST,
    from_axes,
    position,
    Quaternion,
    rotation,
    Triple,
)

__all__ = [
    'COVARIANCE',
    'Pose',
    'PoseWithCovariance',
    'add_covariance',
    'add_pose',
    'ellipsoid_of',
    'pose_shape_properties',
]

COVARIANCE = (
    Flag('Covariance/Value', True, 'Whether the uncertainty of the pose is shown.'),
    Flag('Covariance/Position/Value', True, 'Whether the uncertainty of the position is shown.'),
    ColorOf('Covariance/Position/Color', (204, 51, 204), 'Colour of the ellipsoid.'),
    Number('Covariance/Position/Alpha', 0.3, '0 is transparent.', 0.0, 1.0),
    Number('Covariance/Position/Scale', 1.0, 'Radius in standard deviations.', 0.0),
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
        Choice(shape, 'Arrow', 'How a pose is drawn.', ('Arrow', 'Axes')),
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
    _add_ellipsoid(
        canvas,
        'covariance',
        ellipsoid_of(pose.covariance),
        paint,
        position(pose.pose.position),
        values['Covariance/Position/Scale'],
    )


class Pose(MessageDisplay):
    """The newest pose of a topic."""

    CLASS = 'rviz_default_plugins/Pose'
    MESSAGE = PoseStamped
    PROPERTIES = (
        *topic_properties('geometry_msgs/msg/PoseStamped', '/pose'),
        *pose_shape_properties('Shape'),
    )

    def start(self) -> None:
        """Subscribe to the topic."""
        self._canvas = Canvas(self.context.scene, self.root)
        super().start()

    def show(self, message: Any) -> None:
        """
        Draw the arrow or the axes.

        Parameters
        ----------
        message
            As for `MessageDisplay.show`.

        """
        with self._canvas.anew():
            add_pose(self._canvas, message.pose, self.values, 'Shape')


class PoseWithCovariance(MessageDisplay):
    """The newest pose of a topic, with an ellipsoid around where it may be."""

    CLASS = 'rviz_default_plugins/PoseWithCovariance'
    MESSAGE = PoseWithCovarianceStamped
    PROPERTIES = (
        *topic_properties('geometry_msgs/msg/PoseWithCovarianceStamped', '/initialpose'),
        *pose_shape_properties('Shape'),
        *COVARIANCE,
    )

    def start(self) -> None:
        """Subscribe to the topic."""
        self._canvas = Canvas(self.context.scene, self.root)
        super().start()

    def show(self, message: Any) -> None:
        """
        Draw the pose, and the ellipsoid of its covariance.

        Parameters
        ----------
        message
            As for `MessageDisplay.show`.

        """
        with self._canvas.anew():
            add_covariance(self._canvas, message.pose, self.values)
            add_pose(self._canvas, message.pose.pose, self.values, 'Shape')


class Ellipsoid(NamedTuple):
    """The semi-axes of an ellipsoid in metres, and its rotation."""

    radii: Triple
    wxyz: Quaternion


def ellipsoid_of(covariance: Any) -> Ellipsoid:
    """
    Compute the ellipsoid of one standard deviation of a position.

    Parameters
    ----------
    covariance
        The covariance of a pose: 36 numbers, row-major; those of x, y and z (m^2) are used.

    Raises
    ------
    ValueError
        The numbers are not finite, far too large, or not a valid covariance.

    """
    block = np.asarray(covariance, dtype=float).reshape(6, 6)[:3, :3]
    if not (np.abs(block) <= FARTHEST**2).all():
        raise ValueError('its covariance has numbers that are not finite, or far too large.')
    variances, axes = np.linalg.eigh((block + block.T) / 2.0)
    if variances[0] < -1e-9 * max(1.0, variances[-1]):
        raise ValueError(
            'its covariance is not valid: the variance in some direction is negative.'
        )
    if np.linalg.det(axes) < 0.0:
        axes[:, 0] = -axes[:, 0]
    x, y, z = np.sqrt(np.maximum(variances, 0.0))
    return Ellipsoid((float(x), float(y), float(z)), from_axes(axes))


def _add_ellipsoid(
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
