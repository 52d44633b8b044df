# SPDX-License-Identifier: Apache-2.0
"""The nodes of the scene for frames: few, however many frames there are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from rviz_default_plugins.tf.frame_names import FrameNames
from tf2_py._pose import Pose

if TYPE_CHECKING:
    from viser import SceneApi

__all__ = ['FrameStyle', 'FramesScene', 'Segments']

AXES_M = 0.2
RADIUS_M = 0.02
GREY = (110, 110, 110)
ARROW = (204, 204, 77)
Segments = NDArray[np.float32]
"""Start and end points, N x 2 x 3."""


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
        self._names = FrameNames(scene, f'{path}/names', style.scale)

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
