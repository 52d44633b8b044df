# SPDX-License-Identifier: Apache-2.0
"""Line protocol between the simulator and the render process."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
import json

from humanoid_simulation.camera.picture_noise import PictureNoise
from humanoid_simulation.camera.view import CameraView, Wanted

READY = 'ready'
"""The process can render."""
DONE = 'done'
"""The requested images are in the shared memory."""
FAILED = 'failed '
"""The process ends; the reason follows."""


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
