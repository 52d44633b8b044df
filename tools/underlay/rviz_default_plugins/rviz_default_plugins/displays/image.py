# SPDX-License-Identifier: Apache-2.0
"""The display of an image in a window of the page."""

from __future__ import annotations

from typing import Any

from rviz_common.properties import Flag, Number, Whole
from rviz_default_plugins.decoding.brightness import Brightness
from rviz_default_plugins.decoding.images import Picture
from rviz_default_plugins.displays.image_topic import IMAGE_TOPIC, ImageTopicDisplay
from rviz_default_plugins.drawing.image_window import ImageWindow

__all__ = ['Image']


class Image(ImageTopicDisplay):
    """The newest picture of a topic, in a window that can be moved."""

    CLASS = 'rviz_default_plugins/Image'
    PROPERTIES = (
        *IMAGE_TOPIC,
        Flag('Normalize Range', True, 'Whether the limits are those of the last pictures.'),
        Number('Min Value', 0.0, 'What is black in pictures of depths and the like.'),
        Number('Max Value', 1.0, 'What is white in pictures of depths and the like.'),
        Whole('Median window', 5, 'How many pictures the limits are found in.', 1, 1000),
    )

    def start(self) -> None:
        """Subscribe to the topic."""
        self._window: ImageWindow | None = None
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
            self._window = ImageWindow(self.context.server, self.name, self.QUALITY)
        self._window.show(picture.pixels)

    def brightness(self) -> Brightness:
        """Return the normalisation of images without a fixed value range."""
        if self.values['Normalize Range']:
            return Brightness(window=self.values['Median window'])
        return Brightness((self.values['Min Value'], self.values['Max Value']))
