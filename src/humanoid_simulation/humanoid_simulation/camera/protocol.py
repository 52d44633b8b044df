# SPDX-License-Identifier: Apache-2.0
"""What the simulator and the render process exchange: lines of text, and shared memory."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
import json
import mmap
import os
from typing import Any

from humanoid_simulation.camera.images import Cloud, Color, Depth, PictureNoise
from humanoid_simulation.camera.pinhole import CameraView, Wanted
import numpy as np
from numpy.typing import NDArray

READY = 'ready'
"""The process can render."""
DONE = 'done'
"""The requested images are in the shared memory."""
FAILED = 'failed '
"""The process ends; the reason follows."""
_ALIGNMENT = 64


@dataclass(frozen=True)
class Assignment:
    """What a process renders, how, and the descriptors of the files that it shares."""

    method: str
    model_file: int
    frames_file: int
    views: tuple[CameraView, ...]
    noise: PictureNoise = field(default_factory=PictureNoise)

    def as_text(self) -> str:
        """Serialise the assignment to a command line argument."""
        return json.dumps(asdict(self))

    @staticmethod
    def from_text(text: str) -> Assignment:
        """
        Parse an assignment.

        Parameters
        ----------
        text
            The result of `as_text`.

        """
        given = json.loads(text)
        views = tuple(CameraView(**view) for view in given.pop('views'))
        noise = PictureNoise(**given.pop('noise'))
        return Assignment(**given, views=views, noise=noise)


def request_line(wanted: Sequence[Wanted]) -> str:
    """
    Encode a request for images as a line of JSON.

    Parameters
    ----------
    wanted
        Which images, one element for each view.

    Returns
    -------
    str
        For each view a list [color, depth, cloud] of booleans, with a newline at the end.

    """
    return json.dumps([[each.color, each.depth, each.cloud] for each in wanted]) + '\n'


def wanted_in(line: str) -> list[Wanted]:
    """
    Decode a request for images.

    Parameters
    ----------
    line
        A line from `request_line`.

    Returns
    -------
    list of Wanted
        One element for each view.

    """
    return [Wanted(*each) for each in json.loads(line)]


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
