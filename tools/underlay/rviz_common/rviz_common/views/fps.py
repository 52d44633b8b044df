# SPDX-License-Identifier: Apache-2.0
"""The first-person view."""

from __future__ import annotations

from collections.abc import Mapping
import math
from typing import Any

from rviz_common.properties import Number, Values, Vector
from rviz_common.views.camera_pose import CameraPose
from rviz_common.views.view_kind import COMMON, ViewKind

__all__ = ['Fps']

STEEPEST = math.pi / 2 - 0.001


class Fps(ViewKind):
    """First-person view, which looks around from a point; a positive pitch looks down."""

    CLASS = 'rviz_default_plugins/FPS'
    NAME = 'FPS'
    PROPERTIES = (
        *COMMON,
        Vector('Position', (5.0, 5.0, 10.0), 'The point, from the target frame on.'),
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
