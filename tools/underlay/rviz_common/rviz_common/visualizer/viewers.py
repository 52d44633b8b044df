# SPDX-License-Identifier: Apache-2.0
"""How the page looks in each browser: its theme, and how much is drawn."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
import itertools
import time
from typing import Any, TYPE_CHECKING

from rviz_common.context import Context
from rviz_common.page import Route
from rviz_common.page.channel import Channel, Viewer
from rviz_common.page.page import set_theme
from rviz_common.page.web_files import filled, frame_text, web_file
from rviz_common.visualizer.quality import COARSE, FULL, Quality, SIMPLE
from rviz_common.visualizer.surroundings import DARK, LIGHT, Surroundings
from rviz_common.widget_order import LOOK_ORDER

if TYPE_CHECKING:
    from viser import ClientHandle

__all__ = ['Viewers', 'is_dark_theme']

PATHS = (f'/look/{number}' for number in itertools.count())
"""The paths of the small pages: several visualizers can share a page."""
OF_BROWSER = 'Browser'
STEPS = range(FULL, COARSE + 1)
CHOICES = ('', 'dark', 'light')
"""The themes that a user can choose; '' for that of the file."""


@dataclass
class _Look:
    """What a browser wants, and what was done about it."""

    choice: str = ''
    system: str = ''
    is_dark: bool | None = None
    quality: Quality = field(default_factory=Quality)


class Viewers:
    """
    The browsers that show the page, each with its own theme and quality.

    Each gets a small page among its widgets, which knows what its user and its system prefer,
    and measures how fast the browser draws.

    Parameters
    ----------
    context
        The page, and the queue of the node's thread.

    """

    def __init__(self, context: Context) -> None:
        self._context = context
        self._surroundings = Surroundings(context.scene)
        self._of_file = OF_BROWSER
        self._looks: dict[int, _Look] = {}
        self._is_over = False
        actions = {
            'theme': self._take_theme,
            'quality': self._take_quality,
            'rate': self._take_rate,
        }
        self._channel = Channel(context.queue, lambda viewer: None, actions)
        text = web_file('look.html').replace('/* drawing.js */', web_file('drawing.js'))
        route = Route(filled(text, {}), self._channel.talk)
        self._path = next(PATHS)
        context.page.routes.add(self._path, route)
        context.server.on_client_connect(
            lambda client: context.queue.post(lambda: self._join(client))
        )

    def choose(self, of_file: str, color: tuple[int, int, int], has_ground: bool) -> None:
        """
        Set how the page looks.

        Parameters
        ----------
        of_file
            The theme: `Browser`, `Dark` or `Light`; users of browsers may have chosen another one.
        color, has_ground
            As for `Surroundings.choose`.

        """
        self._surroundings.choose(color, has_ground)
        if of_file == self._of_file:
            return
        self._of_file = of_file
        set_theme(self._context.gui, is_dark_theme('', of_file, ''))
        for look in self._looks.values():
            look.is_dark = None  # the theme of all browsers has just been set
        self._apply_all()

    def update(self) -> None:
        """Draw the surroundings, if they have changed, for all browsers and for each."""
        if self._surroundings.update():
            self._apply_all()

    def clear(self) -> None:
        """Remove the ground and the sky; the next `update` draws everything again."""
        self._surroundings.remove()

    def close(self) -> None:
        """Remove the small page; browsers keep their themes."""
        self._is_over = True
        self._context.page.routes.remove(self._path)
        self._channel.end()

    def _apply_all(self) -> None:
        for client_id, client in self._context.server.get_clients().items():
            if client_id in self._looks:
                self._apply(client, self._looks[client_id])

    def _join(self, client: ClientHandle) -> None:
        clients = self._context.server.get_clients()
        self._looks = {key: look for key, look in self._looks.items() if key in clients}
        if client.client_id in clients and not self._is_over:
            self._looks[client.client_id] = _Look()
            frame = frame_text(self._path, 'look', str(client.client_id))
            client.gui.add_markdown(frame, order=LOOK_ORDER)

    def _take_theme(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        """Take what a browser prefers, or raise ValueError."""
        client, look = self._find(message)
        choice, system = message.get('choice'), message.get('system')
        if choice not in CHOICES or system not in CHOICES:
            raise ValueError(f"There is no theme '{choice}' or '{system}'.")
        look.choice, look.system = choice, system
        self._apply(client, look)

    def _take_quality(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        """Take what a browser can draw, and what its user wants, or raise ValueError."""
        client, look = self._find(message)
        choice, reached = message.get('choice'), message.get('reached', -1)
        if choice not in (None, *STEPS) or reached not in STEPS:
            raise ValueError(f"There is no quality '{choice}' or '{reached}'.")
        look.quality.begin(choice, reached, bool(message.get('has_card')))
        self._apply_quality(viewer, client, look)

    def _take_rate(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        """Take a measured frame rate, or raise ValueError."""
        client, look = self._find(message)
        rate_hz = message.get('hz')
        if not isinstance(rate_hz, (int, float)):
            raise ValueError(f"The frame rate '{rate_hz}' is not a number.")
        if look.quality.report(rate_hz, time.monotonic()):
            self._apply_quality(viewer, client, look)

    def _apply_quality(self, viewer: Viewer, client: ClientHandle, look: _Look) -> None:
        step, sentence = look.quality.step, look.quality.sentence
        is_same = step == SIMPLE and not self._surroundings.has_ground  # nothing has a shadow
        viewer.tell(step=step, sentence='' if is_same else sentence)
        self._apply(client, look)

    def _find(self, message: Mapping[str, Any]) -> tuple[ClientHandle, _Look]:
        """Find the browser that a message is from, or raise ValueError."""
        key = message.get('viewer')
        client = self._context.server.get_clients().get(key) if isinstance(key, int) else None
        if client is None or client.client_id not in self._looks:
            raise ValueError('This page is no longer connected. Reload it.')
        return client, self._looks[client.client_id]

    def _apply(self, client: ClientHandle, look: _Look) -> None:
        is_dark = is_dark_theme(look.choice, self._of_file, look.system)
        if is_dark is not look.is_dark:
            look.is_dark = is_dark
            set_theme(client.gui, is_dark)
        palette, step = DARK if is_dark else LIGHT, look.quality.step
        self._surroundings.adapt(client.scene, palette, step == FULL, step != COARSE)


def is_dark_theme(choice: str, of_file: str, system: str) -> bool:
    """
    Decide about the theme in a browser.

    Parameters
    ----------
    choice
        What its user has chosen: `light`, `dark`, or '' for nothing.
    of_file
        The theme of the file: `Browser`, `Dark` or `Light`.
    system
        What its system prefers: `light`, `dark`, or '' if that is unknown.

    """
    if choice:
        return choice == 'dark'
    if of_file != OF_BROWSER:
        return of_file == 'Dark'
    return system != 'light'
