# SPDX-License-Identifier: Apache-2.0
"""How frames are drawn: with few nodes of the scene, however many frames there are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import islice
from math import dist
from typing import Any, TYPE_CHECKING
from urllib.parse import quote

import numpy as np
from numpy.typing import NDArray
from tf2_py.poses import Pose

if TYPE_CHECKING:
    from viser import LabelHandle, SceneApi

__all__ = ['FrameStyle', 'FramesScene', 'Segments']

AXES_M = 0.2
RADIUS_M = 0.02
GREY = (110, 110, 110)
ARROW = (204, 204, 77)
Segments = NDArray[np.float32]
"""Start and end points, N x 2 x 3."""

HEIGHT_M = 0.06
NEAR_M = 0.002
MAX_MOVES = 50
Place = tuple[float, float, float]


@dataclass(frozen=True)
class FrameStyle:
    """The parts of frames that are shown, and their size."""

    axes: bool = True
    names: bool = False
    arrows: bool = True
    scale: float = 1.0


class FramesScene:
    """
    Axes, arrows and names of frames: one node for all axes or arrows, and one for each name.

    Parameters
    ----------
    scene
        The scene of the viser server.
    path
        The path of the scene below which the nodes are.
    style
        The parts of frames that are shown, and their size.

    """

    def __init__(self, scene: SceneApi, path: str, style: FrameStyle) -> None:
        self._scene, self._path, self._style = scene, path, style
        self._top = scene.add_frame(path, show_axes=False)
        self._axes: Any = None
        self._old_axes: Any = None
        self._arrows: Any = None
        self._names = _FrameNames(scene, f'{path}/names', style.scale)

    def show(self, fresh: Mapping[str, Pose], old: Mapping[str, Pose], arrows: Segments) -> None:
        """
        Show frames according to the style, replacing the previous ones.

        Parameters
        ----------
        fresh, old
            The poses of frames in the fixed frame, by name. The axes of old ones are grey.
        arrows
            The ends of N arrows (N, 2, 3), in m in the fixed frame.

        """
        if self._style.axes:
            self._show_axes(_array(fresh))
            self._show_old(_array(old))
        if self._style.arrows:
            self._show_arrows(arrows)
        if self._style.names:
            self._names.show({**fresh, **old})

    def remove(self) -> None:
        """Remove all nodes."""
        self._top.remove()

    def _show_axes(self, poses: NDArray[np.float32]) -> None:
        positions, wxyzs = poses[:, :3], poses[:, [6, 3, 4, 5]]
        if self._axes is not None and len(self._axes.batched_positions) == len(poses):
            self._axes.batched_positions, self._axes.batched_wxyzs = positions, wxyzs
            return
        _remove(self._axes)
        self._axes = None
        if len(poses):
            self._axes = self._scene.add_batched_axes(
                f'{self._path}/axes',
                wxyzs,
                positions,
                axes_length=AXES_M * self._style.scale,
                axes_radius=RADIUS_M * self._style.scale,
            )

    def _show_old(self, poses: NDArray[np.float32]) -> None:
        segments = _axis_segments(poses, AXES_M * self._style.scale)
        name = f'{self._path}/old_axes'
        if _keeps(self._old_axes, segments):
            self._old_axes.points = segments
            return
        _remove(self._old_axes)
        self._old_axes = None
        if len(segments):
            self._old_axes = self._scene.add_line_segments(
                name, segments, GREY, thickness=3.0, thickness_units='screen'
            )

    def _show_arrows(self, segments: Segments) -> None:
        if _keeps(self._arrows, segments):
            self._arrows.points = segments
            return
        _remove(self._arrows)
        self._arrows = None
        if len(segments):
            scale = self._style.scale
            self._arrows = self._scene.add_arrows(
                f'{self._path}/arrows',
                segments,
                ARROW,
                shaft_radius=0.005 * scale,
                head_radius=0.015 * scale,
                head_length=0.04 * scale,
            )


def _keeps(node: Any, segments: Segments) -> bool:
    """Whether a node has the same number of segments; browsers cannot change that well."""
    return node is not None and len(node.points) == len(segments)


def _remove(node: Any) -> None:
    if node is not None:
        node.remove()


def _array(poses: Mapping[str, Pose]) -> NDArray[np.float32]:
    return np.array(list(poses.values()), np.float32).reshape(-1, 7)


def _axis_segments(poses: NDArray[np.float32], length: float) -> Segments:
    """Return the three axes of each pose as segments."""
    x, y, z, w = poses[:, 3:].T
    columns = [
        (1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)),
        (2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)),
        (2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)),
    ]
    segments = np.repeat(poses[:, None, None, :3], 3, axis=1).repeat(2, axis=2)
    for axis, column in enumerate(columns):
        segments[:, axis, 1] += np.stack(column, axis=1) * length
    return segments.reshape(-1, 2, 3)


class _FrameNames:
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
