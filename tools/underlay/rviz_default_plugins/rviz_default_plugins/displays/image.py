# SPDX-License-Identifier: Apache-2.0
"""The display of an image in a window of the page, and the base class for image topics."""

from __future__ import annotations

import time
from typing import Any, ClassVar
from weakref import WeakKeyDictionary

from rviz_common.properties import Flag, Number, topic_properties, Whole
from rviz_common.status import Level
from rviz_common.topic_display import TopicDisplay
from rviz_default_plugins.decoding.images import (
    Brightness,
    decode_compressed_image,
    decode_image,
    Picture,
)
from sensor_msgs.msg import CompressedImage
from sensor_msgs.msg import Image as ImageMessage

__all__ = ['COMPRESSED', 'IMAGE_TOPIC', 'Image', 'ImageTopicDisplay']

COMPRESSED = ('/compressed', '/compressedDepth')
"""Ends of the names of topics with compressed images: transports of `image_transport`."""

IMAGE_TOPIC = topic_properties('sensor_msgs/msg/Image', '/image')
PERIOD_S = 0.1

WIDTH, GAP = 320, 15


class ImageTopicDisplay(TopicDisplay):
    """
    The newest picture of a topic.

    It is shown at most 10 times a second, and only while a page is open.
    As in RViz2, a topic whose name ends with `/compressed` or `/compressedDepth` has compressed
    images.
    """

    MESSAGE = ImageMessage
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
        Choose the class of the messages by the transport with which the name of the topic ends.

        Parameters
        ----------
        topic
            The topic.

        """
        kind: type = CompressedImage if topic.endswith(COMPRESSED) else ImageMessage
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


class Image(ImageTopicDisplay):
    """The newest picture of a topic, in a window that can be moved."""

    CLASS = 'rviz_default_plugins/Image'
    PROPERTIES = (
        *IMAGE_TOPIC,
        Flag('Normalize Range', True, 'Whether the limits are computed from the last pictures.'),
        Number('Min Value', 0.0, 'Value shown as black in depth and similar images.'),
        Number('Max Value', 1.0, 'Value shown as white in depth and similar images.'),
        Whole(
            'Median window', 5, 'Number of pictures from which the limits are computed.', 1, 1000
        ),
    )

    def start(self) -> None:
        """Subscribe to the topic."""
        self._window: _ImageWindow | None = None
        super().start()

    def stop(self) -> None:
        """Unsubscribe, and close the window."""
        super().stop()
        if self._window is not None:
            self._window.close()
            self._window = None

    def show_picture(self, picture: Picture, header: Any) -> None:
        """
        Show an image in the window, which opens with the first.

        Parameters
        ----------
        picture, header
            As for `ImageTopicDisplay.show_picture`.

        """
        if self._window is None:
            self._window = _ImageWindow(self.context.server, self.name, self.QUALITY)
        self._window.show(picture.pixels)

    def brightness(self) -> Brightness:
        """Return the normalisation of images without a fixed value range."""
        if self.values['Normalize Range']:
            return Brightness(window=self.values['Median window'])
        return Brightness((self.values['Min Value'], self.values['Max Value']))


class _ImageWindow:
    """
    A movable window; it opens at the bottom left, beside the windows already open.

    Parameters
    ----------
    server
        The viser server of the page.
    title
        The title of the window.
    quality
        The quality of the JPEG images sent to browsers, from 0 to 100.

    """

    _taken: ClassVar[WeakKeyDictionary[Any, set[int]]] = WeakKeyDictionary()
    """The places of open windows, by page."""

    def __init__(self, server: Any, title: str, quality: int) -> None:
        self._server = server
        self._quality = quality
        taken = self._taken.setdefault(server, set())
        self._place = next(place for place in range(len(taken) + 1) if place not in taken)
        taken.add(self._place)
        self._panel = server.gui.add_panel()
        self._tab = self._panel.add_tab(title)
        self._panel.float(x=GAP + self._place * (WIDTH + GAP), y=-GAP, width=WIDTH)
        self._image: Any = None

    def show(self, pixels: Any) -> None:
        """
        Show an image, replacing the previous one.

        Parameters
        ----------
        pixels
            Red, green and blue (height, width, 3), from 0 to 255.

        """
        if self._image is not None:
            self._image.image = pixels
            return
        with self._tab:
            self._image = self._server.gui.add_image(
                pixels, format='jpeg', jpeg_quality=self._quality
            )

    def close(self) -> None:
        """Close the window."""
        self._panel.remove()
        self._taken[self._server].discard(self._place)
