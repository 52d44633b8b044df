# SPDX-License-Identifier: Apache-2.0
"""The top-down view."""

from __future__ import annotations

from collections.abc import Mapping
import math
from typing import Any

from rviz_common.properties import Number, Values
from rviz_common.views.camera_pose import CameraPose
from rviz_common.views.view_kind import COMMON, ViewKind

__all__ = ['TopDown']

PIXELS = 800.0
"""The assumed height of the scene for the scale; that of a browser's window differs."""
NARROW = math.radians(10.0)
"""A narrow field of view in rad: from far away it approximates an orthographic camera."""


class TopDown(ViewKind):
    """Top-down view of the ground, as on a map; the scale is in pixels per metre."""

    CLASS = 'rviz_default_plugins/TopDownOrtho'
    NAME = 'TopDownOrtho'
    PROPERTIES = (
        *COMMON,
        Number('Scale', 10.0, 'Pixels a metre.', 0.01, 1e5),
        Number('Angle', 0.0, 'How far the map is turned.'),
        Number('X', 0.0, 'The middle, from the target frame on.'),
        Number('Y', 0.0, 'The middle, from the target frame on.'),
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
