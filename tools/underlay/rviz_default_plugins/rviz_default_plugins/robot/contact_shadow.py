# SPDX-License-Identifier: Apache-2.0
"""A soft shadow on the ground, which shows where a robot stands."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING
from urllib.parse import quote

import numpy as np
from rviz_common.frames import Pose
from rviz_common.glb import glb_of
from rviz_common.visualizer.surroundings import CONTACTS, surface_of

if TYPE_CHECKING:
    from viser import GlbHandle, SceneApi

__all__ = ['ContactShadow']

RADII = (0.0, 0.3, 0.5, 0.7, 0.85, 1.0)
DARKNESS = (0.5, 0.42, 0.28, 0.12, 0.04, 0.0)
WIDTH = 0.6
"""The radius, per height of the root link."""
STEP_M = 0.01
"""The change that is worth a message to browsers."""
LIFT_M = 0.004
"""The height above the ground, above grids and maps."""


class ContactShadow:
    """
    A dark disc below the root link of a robot, on the ground z = 0 of the fixed frame.

    Its width follows from the greatest height of the root link: a robot that has fallen keeps its
    shadow. It is seen if the page shows the ground.

    Parameters
    ----------
    scene
        The scene of the viser server.
    robot
        The path of the robot in the scene, after which the node is named.

    """

    def __init__(self, scene: SceneApi, robot: str) -> None:
        self._scene, self._path = scene, f'{CONTACTS}/{quote(robot, safe="")}'
        self._disc: GlbHandle | None = None
        self._shown: tuple[float, float, float] | None = None
        self._radius_m = 0.0

    def place(self, root: Pose | None) -> None:
        """
        Move the shadow below the robot.

        Parameters
        ----------
        root
            The pose of the root link in the fixed frame; if it is None, or not above the ground,
            there is no shadow.

        """
        if root is None or root.position[2] <= STEP_M:
            self.remove()
            return
        x, y, height = root.position
        radius_m = max(self._radius_m, WIDTH * height)
        wanted = x, y, radius_m
        if self._shown is not None and _are_close(wanted, self._shown):
            return
        self._shown, self._radius_m = wanted, radius_m
        if self._disc is None:
            self._disc = self._scene.add_glb(
                self._path, _disc(), scale=radius_m, cast_shadow=False, receive_shadow=False
            )
        self._disc.scale = radius_m
        self._disc.position = x, y, LIFT_M

    def remove(self) -> None:
        """Remove the shadow; the next `place` draws it again."""
        if self._disc is not None:
            self._disc.remove()
        self._disc, self._shown = None, None


def _are_close(some: tuple[float, ...], others: tuple[float, ...]) -> bool:
    return all(abs(one - other) < STEP_M for one, other in zip(some, others))


@lru_cache(maxsize=1)
def _disc() -> bytes:
    """Return a disc of radius 1, which fades to its edge, as a GLB file."""
    colors = np.zeros((len(RADII), 4), np.uint8)
    colors[:, 3] = [round(255 * each) for each in DARKNESS]
    profile = [(radius, 0.0) for radius in RADII]
    return glb_of(*surface_of(profile, colors), is_lit=False)
