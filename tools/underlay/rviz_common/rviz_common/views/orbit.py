# SPDX-License-Identifier: Apache-2.0
"""The orbit views."""

from __future__ import annotations

from collections.abc import Mapping
import math
from typing import Any

from rviz_common.properties import Number, Values, Vector
from rviz_common.views.camera_pose import CameraPose, Point
from rviz_common.views.view_kind import COMMON, ViewKind

__all__ = ['Orbit', 'ThirdPersonFollower', 'XYOrbit']

STEEPEST = math.pi / 2 - 0.001
"""The pitch limit in rad: straight from above, the up direction would be undefined."""


class Orbit(ViewKind):
    """Orbit view, which looks at a focal point from any direction."""

    CLASS = 'rviz_default_plugins/Orbit'
    NAME = 'Orbit'
    PROPERTIES = (
        *COMMON,
        Number('Distance', 10.0, 'From the point, in metres.', 0.01, 1e6),
        Vector('Focal Point', (0.0, 0.0, 0.0), 'The point, from the target frame on.'),
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
