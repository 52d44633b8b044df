# SPDX-License-Identifier: Apache-2.0
"""How each kind of view, such as an orbit, turns its properties into a camera, and back."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
import math
from typing import Any, ClassVar, NamedTuple

from rviz_common.frames import FIXED_FRAME
from rviz_common.properties import Frame, Number, Property, Values, Vector

__all__ = [
    'CameraPose',
    'Fps',
    'Orbit',
    'Point',
    'ThirdPersonFollower',
    'TopDown',
    'ViewKind',
    'XYOrbit',
]

Point = tuple[float, float, float]

COMMON: tuple[Property, ...] = (
    Frame('Target Frame', FIXED_FRAME, 'The frame that the camera follows.'),
    Number('Near Clip Distance', 0.01, 'Anything nearer is not drawn, in metres.', 0.001, 1000.0),
)

STEEPEST = math.pi / 2 - 0.001
"""The pitch limit in rad: straight from above, the up direction would be undefined."""

PIXELS = 800.0
"""The assumed height of the scene for the scale; that of a browser's window differs."""
NARROW = math.radians(10.0)
"""A narrow field of view in rad: from far away it approximates an orthographic camera."""


class CameraPose(NamedTuple):
    """The position of the camera and its target in metres, and its field of view in radians."""

    position: Point
    look_at: Point
    up: Point = (0.0, 0.0, 1.0)
    fov: float = 0.785
    near: float = 0.01
    far: float = 1000.0


class ViewKind(ABC):
    """A kind of view: converts its properties to a camera, and back."""

    CLASS: ClassVar[str]
    NAME: ClassVar[str]
    PROPERTIES: ClassVar[tuple[Property, ...]]

    @abstractmethod
    def camera(self, values: Values) -> CameraPose:
        """
        Compute the camera from the properties of a view.

        Parameters
        ----------
        values
            The values of `PROPERTIES`.

        Returns
        -------
        CameraPose
            The camera, relative to the origin of the target frame, along the axes of the fixed
            frame.

        """

    @abstractmethod
    def properties(self, camera: CameraPose) -> Mapping[str, Any]:
        """
        Compute the properties of a view from a camera, as far as the kind can express it.

        Parameters
        ----------
        camera
            The camera, relative to the origin of the target frame, along the axes of the fixed
            frame.

        Returns
        -------
        Mapping[str, Any]
            Values by path, for those of `PROPERTIES` that the camera determines.

        """


class Orbit(ViewKind):
    """Orbit view, which looks at a focal point from any direction."""

    CLASS = 'rviz_default_plugins/Orbit'
    NAME = 'Orbit'
    PROPERTIES = (
        *COMMON,
        Number('Distance', 10.0, 'Distance from the focal point, in metres.', 0.01, 1e6),
        Vector('Focal Point', (0.0, 0.0, 0.0), 'The focal point, in the target frame.'),
        Number('Yaw', 0.785, 'The angle about the vertical axis.'),
        Number('Pitch', 0.785, 'The angle above the ground.'),
    )

    def camera(self, values: Values) -> CameraPose:
        """
        Place the camera around the focal point.

        Parameters
        ----------
        values
            As for `ViewKind.camera`.

        """
        focus = self.focus(values['Focal Point'])
        yaw, distance = values['Yaw'], values['Distance']
        pitch = min(max(values['Pitch'], -STEEPEST), STEEPEST)
        across = distance * math.cos(pitch)
        position = (
            focus[0] + across * math.cos(yaw),
            focus[1] + across * math.sin(yaw),
            focus[2] + distance * math.sin(pitch),
        )
        return CameraPose(position, focus, near=values['Near Clip Distance'])

    def properties(self, camera: CameraPose) -> Mapping[str, Any]:
        """
        Compute the focal point, distance, yaw and pitch for a camera.

        Parameters
        ----------
        camera
            As for `ViewKind.properties`.

        Returns
        -------
        Mapping[str, Any]
            Values by path: the point and the distance in m, the angles in rad.

        """
        focus = self.seen(camera)
        dx, dy, dz = (a - b for a, b in zip(camera.position, focus))
        distance = math.sqrt(dx * dx + dy * dy + dz * dz)
        return {
            'Distance': max(distance, 0.01),
            'Focal Point': focus,
            'Yaw': math.atan2(dy, dx) % math.tau,
            'Pitch': math.atan2(dz, math.hypot(dx, dy)),
        }

    def focus(self, point: Point) -> Point:
        """
        Constrain the focal point; here it may be anywhere.

        Parameters
        ----------
        point
            The focal point as set, in m from the origin of the target frame.

        Returns
        -------
        Point
            The point that the camera looks at.

        """
        return point

    def seen(self, camera: CameraPose) -> Point:
        """
        Compute the focal point of a camera.

        Parameters
        ----------
        camera
            The camera, relative to the origin of the target frame.

        Returns
        -------
        Point
            The point that it looks at, in m from the origin of the target frame.

        """
        return camera.look_at


class XYOrbit(Orbit):
    """Orbit view around a point on the ground."""

    CLASS = 'rviz_default_plugins/XYOrbit'
    NAME = 'XYOrbit'

    def focus(self, point: Point) -> Point:
        """
        Project the focal point onto the plane z = 0 of the target frame.

        Parameters
        ----------
        point
            As for `Orbit.focus`.

        """
        return point[0], point[1], 0.0

    def seen(self, camera: CameraPose) -> Point:
        """
        Intersect the line of sight of a camera with the plane z = 0 of the target frame.

        Parameters
        ----------
        camera
            As for `Orbit.seen`.

        Returns
        -------
        Point
            The intersection; the projection of `look_at` if the camera does not look at the plane.

        """
        (x, y, z), (to_x, to_y, to_z) = camera.position, camera.look_at
        drop = z - to_z
        share = z / drop if abs(drop) > 1e-6 else -1.0
        if not 0.0 < share < 1000.0:
            return to_x, to_y, 0.0
        return x + share * (to_x - x), y + share * (to_y - y), 0.0


class ThirdPersonFollower(XYOrbit):
    """Orbit view around a point on the ground, which follows the target frame from behind."""

    CLASS = 'rviz_default_plugins/ThirdPersonFollower'
    NAME = 'ThirdPersonFollower'


class Fps(ViewKind):
    """First-person view, which looks around from a point; a positive pitch looks down."""

    CLASS = 'rviz_default_plugins/FPS'
    NAME = 'FPS'
    PROPERTIES = (
        *COMMON,
        Vector('Position', (5.0, 5.0, 10.0), 'The camera position, in the target frame.'),
        Number('Yaw', 0.0, 'The angle about the vertical axis.'),
        Number('Pitch', 0.0, 'The angle below the horizon.'),
    )

    def camera(self, values: Values) -> CameraPose:
        """
        Place the camera by position, yaw and pitch.

        Parameters
        ----------
        values
            As for `ViewKind.camera`.

        """
        x, y, z = values['Position']
        yaw = values['Yaw']
        pitch = min(max(values['Pitch'], -STEEPEST), STEEPEST)
        across = math.cos(pitch)
        look_at = (x + across * math.cos(yaw), y + across * math.sin(yaw), z - math.sin(pitch))
        return CameraPose((x, y, z), look_at, near=values['Near Clip Distance'])

    def properties(self, camera: CameraPose) -> Mapping[str, Any]:
        """
        Compute position, yaw and pitch for a camera.

        Parameters
        ----------
        camera
            As for `ViewKind.properties`.

        Returns
        -------
        Mapping[str, Any]
            Values by path: the position in m, the angles in rad.

        """
        dx, dy, dz = (b - a for a, b in zip(camera.position, camera.look_at))
        return {
            'Position': camera.position,
            'Yaw': math.atan2(dy, dx) % math.tau,
            'Pitch': -math.atan2(dz, math.hypot(dx, dy)),
        }


class TopDown(ViewKind):
    """Top-down view of the ground, as on a map; the scale is in pixels per metre."""

    CLASS = 'rviz_default_plugins/TopDownOrtho'
    NAME = 'TopDownOrtho'
    PROPERTIES = (
        *COMMON,
        Number('Scale', 10.0, 'Pixels per metre.', 0.01, 1e5),
        Number('Angle', 0.0, 'Rotation of the map.'),
        Number('X', 0.0, 'The centre, in the target frame.'),
        Number('Y', 0.0, 'The centre, in the target frame.'),
    )

    def camera(self, values: Values) -> CameraPose:
        """
        Place the camera above the ground, far away and with a narrow field of view.

        Parameters
        ----------
        values
            As for `ViewKind.camera`.

        """
        x, y, angle = values['X'], values['Y'], values['Angle']
        height = PIXELS / values['Scale'] / 2.0 / math.tan(NARROW / 2.0)
        up = (-math.sin(angle), math.cos(angle), 0.0)
        return CameraPose(
            (x, y, height), (x, y, 0.0), up, NARROW, height / 1000.0, max(height * 2.0, 1000.0)
        )

    def properties(self, camera: CameraPose) -> Mapping[str, Any]:
        """
        Compute scale, angle and centre of the map for a camera.

        Parameters
        ----------
        camera
            As for `ViewKind.properties`.

        Returns
        -------
        Mapping[str, Any]
            Values by path: the scale in pixels per m, the angle in rad, x and y in m.

        """
        height = max(camera.position[2] - camera.look_at[2], 0.01)
        metres = 2.0 * height * math.tan(camera.fov / 2.0)
        return {
            'Scale': min(max(PIXELS / metres, 0.01), 1e5),
            'Angle': math.atan2(-camera.up[0], camera.up[1]),
            'X': camera.look_at[0],
            'Y': camera.look_at[1],
        }
