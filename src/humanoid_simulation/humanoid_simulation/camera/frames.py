# SPDX-License-Identifier: Apache-2.0
"""Memory shared by the simulator and the render process."""

from __future__ import annotations

from collections.abc import Sequence
import mmap
import os
from typing import Any

from humanoid_simulation.camera.painter import Cloud, Color, Depth
from humanoid_simulation.camera.view import CameraView
import numpy as np
from numpy.typing import NDArray

_ALIGNMENT = 64


class Frames:
    """
    Shared memory for the positions of a state, and for the images and point clouds of its views.

    The memory is anonymous, and is freed with the last process that holds it.

    Parameters
    ----------
    file
        File descriptor of the memory, from `unnamed_file`; the file is resized as needed.
    nq
        Number of generalised positions of the MuJoCo model.
    views
        The views, in the same order in each process.

    Attributes
    ----------
    qpos
        The generalised positions (nq,).
    colors, depths, clouds
        One array for each view, see `Color`, `Depth` and `Cloud`.

    """

    def __init__(self, file: int, nq: int, views: Sequence[CameraView]) -> None:
        sizes = [nq * 8]
        for view in views:
            pixels = view.width_px * view.height_px
            sizes += [pixels * 3, pixels * 4, pixels * 12]
        ends = np.cumsum([-(-size // _ALIGNMENT) * _ALIGNMENT for size in sizes])
        os.ftruncate(file, int(ends[-1]))
        self._memory = mmap.mmap(file, int(ends[-1]))
        starts = [0, *(int(end) for end in ends[:-1])]
        self.qpos: NDArray[np.float64] = self._array(np.float64, 0, nq)
        self.colors: list[Color] = [
            self._array(np.uint8, start, view.height_px, view.width_px, 3)
            for start, view in zip(starts[1::3], views)
        ]
        self.depths: list[Depth] = [
            self._array(np.float32, start, view.height_px, view.width_px)
            for start, view in zip(starts[2::3], views)
        ]
        self.clouds: list[Cloud] = [
            self._array(np.float32, start, view.height_px, view.width_px, 3)
            for start, view in zip(starts[3::3], views)
        ]

    def _array(self, kind: Any, start: int, *shape: int) -> NDArray[Any]:
        """Return a part of the memory as an array."""
        count = int(np.prod(shape))
        return np.frombuffer(self._memory, kind, count, start).reshape(shape)


def unnamed_file(purpose: str) -> int:
    """
    Create an anonymous file in memory; other processes reach it by its file descriptor only.

    Parameters
    ----------
    purpose
        A word for its name in /proc, for debugging.

    Returns
    -------
    int
        The file descriptor, which the caller closes.

    """
    return os.memfd_create(f'humanoid_simulation_{purpose}')
