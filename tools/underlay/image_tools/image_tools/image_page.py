# SPDX-License-Identifier: Apache-2.0
"""The page that shows the newest image."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Mapping
from importlib.resources import files
from typing import Any

from image_transport.pixels import packed
from rviz_common.inputs import WorkQueue
from rviz_common.page import PageSettings, PlainPage, Route
from rviz_common.page.channel import Channel, Viewer
from rviz_default_plugins.decoding.images import Brightness, decode_image
from sensor_msgs.msg import Image

__all__ = ['ImagePage']

FILES = {'': 'image.html', '/image.css': 'image.css', '/image.js': 'image.js'}
KINDS = {'html': 'text/html', 'css': 'text/css', 'js': 'text/javascript'}
QUALITY = 85


class ImagePage:
    """
    A page with the newest image of a topic.

    A browser gets an image when it asks for one: a slow browser gets fewer, and never an old one.

    Parameters
    ----------
    title
        The title of the page.
    queue
        Transfers what browsers ask for to the thread of the node.
    settings
        Where the page is served, and to whom.

    Raises
    ------
    PortError
        The host or the port cannot be used.

    """

    def __init__(self, title: str, queue: WorkQueue, settings: PageSettings) -> None:
        self._title = title
        self._brightness = Brightness()
        self._image: Image | None = None
        self._news: dict[str, Any] | None = None
        self._waiting: set[Viewer] = set()
        self._channel = Channel(queue, self._greet, {'next': self._ask})
        self._page = PlainPage(title, _routes(self._channel), settings)

    @property
    def urls(self) -> list[str]:
        """The URLs to open; the best one first."""
        return self._page.urls

    def show(self, image: Image) -> None:
        """
        Show an image to all browsers that have drawn the one before.

        Parameters
        ----------
        image
            The image, of any encoding.

        """
        self._image, self._news = image, None
        self._waiting.intersection_update(self._channel.viewers)
        if self._waiting:
            news = self._described()
            for viewer in self._waiting:
                viewer.tell(**news)
            self._waiting.clear()

    def close(self) -> None:
        """Stop serving the page."""
        self._channel.end()
        self._page.close()

    def _greet(self, viewer: Viewer) -> None:
        viewer.tell(title=self._title)
        if self._image is None:
            self._waiting.add(viewer)
        else:
            viewer.tell(**self._described())

    def _ask(self, viewer: Viewer, _: Mapping[str, Any]) -> None:
        self._waiting.add(viewer)

    def _described(self) -> dict[str, Any]:
        """Return the image for browsers, or why it cannot be shown; compressed only once."""
        image = self._image
        if self._news is None and image is not None:
            text = f'{image.width} x {image.height}, {image.encoding}'
            try:
                pixels = decode_image(image, self._brightness).pixels
                jpeg = b64encode(packed(pixels, 'JPEG', quality=QUALITY)).decode()
                self._news = {'image': jpeg, 'about': text, 'fault': ''}
            except ValueError as error:
                self._news = {'image': '', 'about': text, 'fault': f'The image is broken: {error}'}
        return self._news or {}


def _routes(channel: Channel) -> dict[str, Route]:
    """Return the files of the page, the first with its connection."""
    folder = files('image_tools') / 'web'
    return {
        path: Route(
            (folder / name).read_text(encoding='utf-8'),
            None if path else channel.talk,
            f'{KINDS[name.rpartition(".")[2]]}; charset=utf-8',
        )
        for path, name in FILES.items()
    }
