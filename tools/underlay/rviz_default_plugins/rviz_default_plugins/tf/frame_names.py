# SPDX-License-Identifier: Apache-2.0
"""The names of frames in the scene."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING
from urllib.parse import quote

from tf2_py._pose import Pose

if TYPE_CHECKING:
    from viser import LabelHandle, SceneApi

__all__ = ['FrameNames']

HEIGHT_M = 0.06
NEAR_M = 0.002


class FrameNames:
    """A label at each frame; it is moved only when its frame has moved so far that one sees it."""

    def __init__(self, scene: SceneApi, path: str, scale: float) -> None:
        """Show no names yet."""
        self._scene, self._path, self._scale = scene, path, scale
        self._labels: dict[str, LabelHandle] = {}
        self._places: dict[str, tuple[float, ...]] = {}

    def show(self, poses: Mapping[str, Pose]) -> None:
        """Show these names, and no others."""
        for frame in self._labels.keys() - poses.keys():
            self._labels.pop(frame).remove()
            del self._places[frame]
        for frame, pose in poses.items():
            self._place(frame, pose[:3])

    def _place(self, frame: str, place: tuple[float, ...]) -> None:
        x, y, z = place
        before = self._places.get(frame)
        if before is None:
            self._labels[frame] = self._scene.add_label(
                f'{self._path}/{quote(frame, safe="")}',
                frame,
                position=(x, y, z),
                font_size_mode='scene',
                font_scene_height=HEIGHT_M * self._scale,
            )
        elif max(abs(a - b) for a, b in zip(place, before)) > NEAR_M * self._scale:
            self._labels[frame].position = (x, y, z)
        else:
            return
        self._places[frame] = place
