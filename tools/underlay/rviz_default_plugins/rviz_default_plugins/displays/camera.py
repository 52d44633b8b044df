# SPDX-License-Identifier: Apache-2.0
"""The display of a camera image with its frustum."""

from __future__ import annotations

import math
from typing import Any

from rviz_common.canvas import Canvas
from rviz_common.frames import FrameError
from rviz_common.properties import Number
from rviz_common.status import Level
from rviz_default_plugins.decoding.images import Picture
from rviz_default_plugins.displays.image import COMPRESSED, IMAGE_TOPIC, ImageTopicDisplay
from sensor_msgs.msg import CameraInfo

__all__ = ['Camera']

MOST_DISTANT = 1.0


class Camera(ImageTopicDisplay):
    """The newest picture of a topic, on the pyramid that the camera sees."""

    CLASS = 'rviz_default_plugins/Camera'
    PROPERTIES = (
        *IMAGE_TOPIC,
        Number(
            'Far Plane Distance',
            100.0,
            f'Distance of the picture, in metres; at most {MOST_DISTANT:g}.',
            0.001,
        ),
    )
    UNUSED = ('Image Rendering', 'Overlay Alpha', 'Visibility', 'Zoom Factor')

    def start(self) -> None:
        """Subscribe to the image and the CameraInfo."""
        self._canvas = Canvas(self.context.scene, self.root)
        self._info: Any = None
        super().start()
        if topic := self.values['Topic/Value']:
            self._info_topic = info_topic(topic)
            if self.subscribe(CameraInfo, self._info_topic, self._take_info):
                self._say_no_info()

    def update(self) -> None:
        """Show the newest image, and follow the camera."""
        super().update()
        if self._shown is not None:
            self._follow(self._shown.header)

    def show_picture(self, picture: Picture, header: Any) -> None:
        """
        Draw the frustum of the camera with the image, once its CameraInfo is known.

        Parameters
        ----------
        picture, header
            As for `ImageTopicDisplay.show_picture`.

        """
        if self._info is None:
            self._say_no_info()
            return
        angle, aspect = view_of(self._info)
        self.status.forget('Camera Info')
        pyramid = self._canvas.put(
            'camera_frustum',
            'camera',
            fov=angle,
            aspect=aspect,
            image=picture.pixels,
            format='jpeg',
            jpeg_quality=self.QUALITY,
            cast_shadow=False,
        )
        depth = min(self.values['Far Plane Distance'], MOST_DISTANT)
        pyramid.scale = depth / pyramid.compute_canonical_frustum_size()[2]

    def _take_info(self, message: Any) -> None:
        if self._info is None or view_numbers(message) != view_numbers(self._info):
            self.redraw()
        self._info = message

    def _say_no_info(self) -> None:
        self.status.say(
            'Camera Info',
            Level.WARN,
            f'No message received on {self._info_topic} yet: the camera calibration is unknown.',
        )

    def _follow(self, header: Any) -> None:
        try:
            pose = self.context.frames.pose(header.frame_id)
        except FrameError as error:
            self.status.say('Transform', Level.ERROR, str(error))
            self._frame.visible = False
            return
        self.status.forget('Transform')
        self._frame.visible = True
        self._frame.position, self._frame.wxyz = pose


def info_topic(topic: str) -> str:
    """
    Derive the topic of the CameraInfo that belongs to a topic of images.

    Parameters
    ----------
    topic
        The topic of images, such as `/camera/image_raw` or `/camera/image_raw/compressed`.

    Returns
    -------
    str
        Such as `/camera/camera_info`.

    """
    image = topic.rpartition('/')[0] if topic.endswith(COMPRESSED) else topic
    return f'{image.rpartition("/")[0]}/camera_info'.replace('//', '/')


def view_numbers(info: Any) -> tuple[float, ...]:
    """
    Select the parameters that determine the field of view of a camera.

    Parameters
    ----------
    info
        The message, of the type `sensor_msgs/msg/CameraInfo`.

    Returns
    -------
    tuple[float, ...]
        The width and height of images and the focal lengths fx and fy, all in pixels.

    """
    return info.width, info.height, info.k[0], info.k[4]


def view_of(info: Any) -> tuple[float, float]:
    """
    Compute the field of view of a camera.

    Parameters
    ----------
    info
        The message, of the type `sensor_msgs/msg/CameraInfo`.

    Returns
    -------
    tuple[float, float]
        The vertical field of view in rad, and the aspect ratio: width over height.

    Raises
    ------
    ValueError
        The camera is not calibrated, or its image size is zero.

    """
    width, height, across, along = view_numbers(info)
    if not (width and height):
        raise ValueError(f'its CameraInfo says that it is {width} wide and {height} high.')
    if not (math.isfinite(across) and math.isfinite(along) and across > 0.0 and along > 0.0):
        raise ValueError(
            f'its CameraInfo has no focal lengths, but {across:g} and {along:g}: the camera is '
            'not calibrated.'
        )
    return 2.0 * math.atan(height / (2.0 * along)), (width / across) / (height / along)
