# SPDX-License-Identifier: Apache-2.0
"""What the camera sees at the time of an image: its pose, intrinsics and depth."""

from __future__ import annotations

from collections.abc import Callable
import math
import struct

from humanoid_common.qos import SENSOR
from humanoid_perception.images import depth_of, ImageError
from humanoid_perception.visibility import View
import numpy as np
import numpy.typing as npt
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.serialization import deserialize_message
from rclpy.time import Time
from sensor_msgs.msg import CameraInfo, Image
from tf2_ros import TransformException

__all__ = ['CameraViews', 'LatestCameraInfo']

Array = npt.NDArray[np.float64]
LookUp = Callable[[str, str, Time], tuple[Array, Array]]
"""Returns the pose of a child frame in a frame at a time, or raises TransformException."""

_BEFORE = Duration(seconds=0.1)
"""Time span over which the turn rate of the camera is measured."""
_KEPT_DEPTHS = 8


class LatestCameraInfo:
    """
    The latest camera_info, of which only the stamp changes with most images.

    Attributes
    ----------
    message
        The message, with the stamp of the first one of its content; None before there is one.

    """

    def __init__(self) -> None:
        self.message: CameraInfo | None = None
        self._content = b''

    def take(self, data: bytes) -> None:
        """
        Store a message; deserialize it only if more than its stamp has changed.

        Parameters
        ----------
        data
            The serialized message.

        """
        if data[12:] != self._content:
            self._content = data[12:]
            self.message = deserialize_message(data, CameraInfo)


class CameraViews:
    """
    Views of the camera, from `camera/camera_info`, `camera/depth/image_raw` and transforms.

    Parameters
    ----------
    node
        The node that subscribes.
    look_up
        Looks up transforms.
    warn
        Receives a sentence about a depth image that cannot be used.

    """

    def __init__(self, node: Node, look_up: LookUp, warn: Callable[[str], None]) -> None:
        self._look_up, self._warn = look_up, warn
        self._camera = LatestCameraInfo()
        self._depths: dict[bytes, bytes] = {}
        node.create_subscription(
            CameraInfo, 'camera/camera_info', self._camera.take, SENSOR, raw=True
        )
        node.create_subscription(
            Image, 'camera/depth/image_raw', self._take_depth, SENSOR, raw=True
        )

    def clear(self) -> None:
        """Forget the depth images."""
        self._depths.clear()

    def at(self, frame: str, stamp: Time) -> View | None:
        """
        Create the view of an image, with its depth if that was received.

        Parameters
        ----------
        frame
            The frame of the view.
        stamp
            The stamp of the image.

        Returns
        -------
        View or None
            The view; None without a valid camera_info.

        Raises
        ------
        TransformException
            The pose of the camera is not known.

        """
        camera = self._camera.message
        if camera is None or not camera.width or not camera.k[0] > 0.0 or not camera.k[4] > 0.0:
            return None
        position, rotation = self._look_up(frame, camera.header.frame_id, stamp)
        turn_rad_s = 0.0
        try:
            _, before = self._look_up(frame, camera.header.frame_id, stamp - _BEFORE)
            cosine = (float(np.trace(before.T @ rotation)) - 1.0) / 2.0
            turn_rad_s = math.acos(max(-1.0, min(1.0, cosine))) / (_BEFORE.nanoseconds * 1e-9)
        except (TransformException, ValueError):
            pass
        return View(
            stamp.nanoseconds * 1e-9,
            position,
            rotation,
            camera.width,
            camera.height,
            camera.k[0],
            camera.k[4],
            camera.k[2],
            camera.k[5],
            self._depth_at(stamp),
            turn_rad_s,
        )

    def _take_depth(self, data: bytes) -> None:
        """Buffer a serialized depth image until the detections with its stamp arrive."""
        self._depths[data[4:12]] = data
        while len(self._depths) > _KEPT_DEPTHS:
            del self._depths[next(iter(self._depths))]

    def _depth_at(self, stamp: Time) -> npt.NDArray[np.float32] | None:
        """Return the depth image with a stamp, if it was received."""
        for order in '<>':
            data = self._depths.get(struct.pack(f'{order}iI', *stamp.seconds_nanoseconds()))
            if data is not None:
                try:
                    return depth_of(deserialize_message(data, Image))
                except ImageError as error:
                    self._warn(f'Occlusions are unknown. {error}')
        return None
