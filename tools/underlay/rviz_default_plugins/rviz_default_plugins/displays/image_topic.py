# SPDX-License-Identifier: Apache-2.0
"""The base class of displays of image topics."""

from __future__ import annotations

import time
from typing import Any, ClassVar

from rviz_common.properties import topic_properties
from rviz_common.status import Level
from rviz_common.topic_display import TopicDisplay
from rviz_default_plugins.decoding.brightness import Brightness
from rviz_default_plugins.decoding.compressed_images import decode_compressed_image
from rviz_default_plugins.decoding.images import decode_image, Picture
from sensor_msgs.msg import CompressedImage, Image

__all__ = ['IMAGE_TOPIC', 'ImageTopicDisplay']

IMAGE_TOPIC = topic_properties('sensor_msgs/msg/Image', '/image')
PERIOD_S = 0.1


class ImageTopicDisplay(TopicDisplay):
    """
    The newest picture of a topic.

    It is shown at most 10 times a second, and only while a page is open.
    A topic whose name ends with `/compressed` has compressed images.
    """

    MESSAGE = Image
    QUALITY: ClassVar[int] = 75

    def start(self) -> None:
        """Subscribe to the topic."""
        self._newest: Any = None
        self._shown: Any = None
        self._shown_s = -PERIOD_S
        self._brightness = self.brightness()
        super().start()

    def update(self) -> None:
        """Show the newest image."""
        super().update()
        message = self._newest
        if message is None or message is self._shown or not self.is_looked_at():
            return
        if self.now_s() - self._shown_s < PERIOD_S:
            return
        self._shown, self._shown_s = message, self.now_s()
        try:
            picture = self._decoded(message)
            self._say_size(picture)
            self.show_picture(picture, message.header)
        except ValueError as error:
            self.say_left_out(error)
            return
        self.say_shown()

    def show_picture(self, picture: Picture, header: Any) -> None:
        """
        Show an image; called at most 10 times a second, and only while a page is open.

        Parameters
        ----------
        picture
            The decoded image, small enough for a page.
        header
            The header of its message.

        Raises
        ------
        ValueError
            The image cannot be shown; the reason is shown in the status.

        """
        raise NotImplementedError

    def brightness(self) -> Brightness:
        """Return the normalisation of images without a fixed value range."""
        return Brightness()

    def message_type(self, topic: str) -> type:
        """
        Choose the class of the messages: compressed images if the topic ends with `/compressed`.

        Parameters
        ----------
        topic
            The topic.

        """
        kind: type = CompressedImage if topic.endswith('/compressed') else Image
        return kind

    def take(self, message: Any) -> None:
        """
        Store the newest image; it is only decoded when it is shown.

        Parameters
        ----------
        message
            As for `TopicDisplay.take`.

        """
        self._newest = message

    def redraw(self) -> None:
        """Show the newest image again."""
        self._brightness = self.brightness()
        self._shown, self._shown_s = None, -PERIOD_S

    def is_looked_at(self) -> bool:
        """Whether a page is open."""
        return bool(self.context.server.get_clients())

    def now_s(self) -> float:
        """Return the monotonic time used to limit the rate of images."""
        return time.monotonic()

    def _decoded(self, message: Any) -> Picture:
        if isinstance(message, CompressedImage):
            return decode_compressed_image(message, self._brightness)
        return decode_image(message, self._brightness)

    def _say_size(self, picture: Picture) -> None:
        if picture.step == 1:
            self.status.forget('Size')
            return
        height, width, _ = picture.pixels.shape
        sentence = f'The picture is shown {picture.step} times smaller, as {width} x {height}.'
        self.status.say('Size', Level.WARN, sentence)
