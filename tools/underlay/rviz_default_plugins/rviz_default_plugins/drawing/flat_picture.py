# SPDX-License-Identifier: Apache-2.0
"""An image in the scene that is updated often, such as a costmap."""

from __future__ import annotations

from typing import Any

import numpy as np
from rviz_default_plugins.decoding.geometry import Quaternion, Triple

__all__ = ['FlatPicture']

NOTHING = np.zeros((1, 1, 4), np.uint8)


class FlatPicture:
    """
    A flat image in the scene, given as a PNG file.

    The scene of viser accepts pixels and encodes them itself, with three bytes of colour each; a
    palette of 256 colours is encoded in a seventh of the time, to a sixth of the size.

    Parameters
    ----------
    scene
        The scene of the viser server.
    path
        The path of the image in the scene; no node exists before `show`.

    """

    def __init__(self, scene: Any, path: str) -> None:
        self._scene, self._path = scene, path
        self._handle: Any = None
        self._place: tuple[Any, ...] = ()

    def show(
        self, png: bytes, size_m: tuple[float, float], position: Triple, wxyz: Quaternion
    ) -> None:
        """
        Show an image, replacing the previous one.

        Parameters
        ----------
        png
            The contents of a PNG file.
        size_m
            Width and height, in m.
        position
            The centre of the image, in m in the frame of the parent node.
        wxyz
            Its rotation, as w, x, y and z.

        """
        place = (size_m, position, wxyz)
        if self._handle is None:
            width, height = size_m
            self._handle = self._scene.add_image(
                self._path, NOTHING, width, height, format='png', position=position, wxyz=wxyz
            )
        elif place != self._place:
            self._handle.render_width, self._handle.render_height = size_m
            self._handle.position, self._handle.wxyz = position, wxyz
        self._place = place
        self._handle._data = png

    def remove(self) -> None:
        """Remove the image."""
        if self._handle is not None:
            self._handle.remove()
            self._handle = None
