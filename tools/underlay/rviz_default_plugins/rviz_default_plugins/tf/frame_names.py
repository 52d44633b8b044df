# SPDX-License-Identifier: Apache-2.0
"""The names of frames in the scene."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import islice
from math import dist
from typing import TYPE_CHECKING
from urllib.parse import quote

from tf2_py._pose import Pose

if TYPE_CHECKING:
    from viser import LabelHandle, SceneApi

__all__ = ['FrameNames']

HEIGHT_M = 0.06
NEAR_M = 0.002
MAX_MOVES = 50
Place = tuple[float, float, float]


class FrameNames:
    """
    Labels at the frames, each of which is updated when its frame has moved visibly.

    Each label is a separate message. If many move, they are updated in turn.

    Parameters
    ----------
    scene
        The scene of the viser server.
    path
        The path of the scene below which the labels are.
    scale
        The height of the labels, as a multiple of 0.06 m.

    """

    def __init__(self, scene: SceneApi, path: str, scale: float) -> None:
        self._scene, self._path, self._scale = scene, path, scale
        self._labels: dict[str, LabelHandle] = {}
        # The label that was updated least recently comes first.
        self._places: dict[str, Place] = {}

    def show(self, poses: Mapping[str, Pose]) -> None:
        """
        Show the names of these frames, and no others.

        Parameters
        ----------
        poses
            The poses of the frames in the fixed frame, by name.

        """
        for frame in self._labels.keys() - poses.keys():
            self._labels.pop(frame).remove()
            del self._places[frame]
        for frame in poses.keys() - self._labels.keys():
            self._add(frame, poses[frame][:3])
        far = (frame for frame, place in self._places.items() if self._is_far(place, poses[frame]))
        for frame in list(islice(far, MAX_MOVES)):
            del self._places[frame]
            self._places[frame] = self._labels[frame].position = poses[frame][:3]

    def _is_far(self, place: Place, pose: Pose) -> bool:
        return dist(place, pose[:3]) > NEAR_M * self._scale

    def _add(self, frame: str, place: Place) -> None:
        self._places[frame] = place
        self._labels[frame] = self._scene.add_label(
            f'{self._path}/{quote(frame, safe="")}',
            frame,
            position=place,
            font_size_mode='scene',
            font_scene_height=HEIGHT_M * self._scale,
        )
