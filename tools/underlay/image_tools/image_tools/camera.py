# SPDX-License-Identifier: Apache-2.0
"""A camera of this computer, by OpenCV."""

from __future__ import annotations

from typing import Any

from cv_bridge.conversion import opencv
import numpy as np
from numpy.typing import NDArray

__all__ = ['Camera']

WAY_OUT = 'Without a camera, draw a picture instead: --ros-args -p burger_mode:=true'


class Camera:
    """
    An open camera.

    Parameters
    ----------
    device_id
        The number of the camera; 0 is the first one.
    width, height
        The size of the images that are asked for, in pixels; the camera may choose another one.

    Raises
    ------
    ValueError
        There is no such camera, or OpenCV is not installed.

    """

    def __init__(self, device_id: int, width: int, height: int) -> None:
        try:
            cv2 = opencv('reads cameras')
        except ImportError as error:
            raise ValueError(f'{error}. {WAY_OUT}') from error
        self._device_id = device_id
        self._capture: Any = cv2.VideoCapture(device_id)
        if not self._capture.isOpened():
            raise ValueError(
                f'The camera {device_id} cannot be opened. Another one is chosen by '
                f'-p device_id:=1. {WAY_OUT}'
            )
        self._capture.set(cv2.CAP_PROP_FRAME_WIDTH, float(width))
        self._capture.set(cv2.CAP_PROP_FRAME_HEIGHT, float(height))

    def read(self) -> NDArray[np.uint8]:
        """
        Wait for the next image.

        Returns
        -------
        numpy.ndarray
            Rows of red, green and blue.

        Raises
        ------
        ValueError
            The camera gives no more images.

        """
        is_read, pixels = self._capture.read()
        if not is_read:
            raise ValueError(f'The camera {self._device_id} gives no images: is it connected?')
        return np.ascontiguousarray(pixels[:, :, ::-1])

    def close(self) -> None:
        """Let others use the camera."""
        self._capture.release()
