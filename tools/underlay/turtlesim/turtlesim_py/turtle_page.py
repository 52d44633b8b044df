# SPDX-License-Identifier: Apache-2.0
"""The page that shows the turtles, and drives the first one."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Mapping
from importlib.resources import files
import time
from typing import Any

from rviz_common.inputs import WorkQueue
from rviz_common.page import PageSettings, PlainPage, Route
from rviz_common.page.channel import Channel, Viewer
from turtlesim_py.canvas import FIELD, Line, SIDE_PX
from turtlesim_py.turtle import Velocity
from turtlesim_py.world import FIRST, World

__all__ = ['TurtlePage']

SPEED, TURN_RATE = 2.0, 2.0
"""The velocity of a key that is held, as of `turtle_teleop_key`."""
FILES = {'': 'turtlesim.html', '/turtlesim.css': 'turtlesim.css', '/turtlesim.js': 'turtlesim.js'}
KINDS = {'html': 'text/html', 'css': 'text/css', 'js': 'text/javascript'}


class TurtlePage:
    """
    The page of a field of turtles.

    Parameters
    ----------
    name
        The name of the node, which the page shows.
    world
        The turtles.
    queue
        Transfers what browsers ask for to the thread of the node.
    settings
        Where the page is served, and to whom.

    Raises
    ------
    PortError
        The host or the port cannot be used.

    """

    def __init__(self, name: str, world: World, queue: WorkQueue, settings: PageSettings) -> None:
        self._name = name
        self._world = world
        self._channel = Channel(queue, self._greet, {'drive': self._drive})
        self._shown: dict[str, Any] = {}
        self._page = PlainPage(name, _routes(self._channel), settings)

    @property
    def urls(self) -> list[str]:
        """The URLs to open; the best one first."""
        return self._page.urls

    def refresh(self) -> None:
        """Send what has changed to all browsers."""
        was_cleared, lines = self._world.canvas.take_changes()
        if not self._channel.viewers:
            return
        state = self._state()
        news = {key: value for key, value in state.items() if value != self._shown.get(key)}
        self._shown = state
        if was_cleared:
            news['image'] = ''
        if lines:
            news['lines'] = [_described(line) for line in lines]
        if news:
            self._channel.tell(**news)

    def close(self) -> None:
        """Stop serving the page."""
        self._channel.end()
        self._page.close()

    def _greet(self, viewer: Viewer) -> None:
        canvas = self._world.canvas
        image = '' if canvas.is_blank else b64encode(canvas.png()).decode()
        viewer.tell(name=self._name, field=FIELD, side=SIDE_PX, image=image, **self._state())

    def _state(self) -> dict[str, Any]:
        turtles = [
            [each.name, each.number, round(each.x, 4), round(each.y, 4), round(each.theta, 4)]
            for each in self._world.turtles.values()
        ]
        return {'background': self._world.background, 'turtles': turtles}

    def _drive(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        """Move the first turtle as keys are held: forward or back, and to which side."""
        forward, turn = (_share(message.get(axis)) for axis in ('forward', 'turn'))
        velocity = Velocity(forward=SPEED * forward, turn=TURN_RATE * turn)
        self._world.command(FIRST, velocity, time.monotonic())


def _routes(channel: Channel) -> dict[str, Route]:
    """Return the files of the page, the first with its connection."""
    folder = files('turtlesim_py') / 'web'
    return {
        path: Route(
            (folder / name).read_text(encoding='utf-8'),
            None if path else channel.talk,
            f'{KINDS[name.rpartition(".")[2]]}; charset=utf-8',
        )
        for path, name in FILES.items()
    }


def _described(line: Line) -> list[Any]:
    """Return a line for the browser: colour, width, and the coordinates of its points."""
    numbers = [round(number, 1) for point in line.points for number in point]
    return [line.pen.colour, line.pen.width_px, numbers]


def _share(value: Any) -> float:
    """Return a number from -1 to 1 of a browser."""
    if not isinstance(value, (int, float)) or not -1.0 <= value <= 1.0:
        raise ValueError(f'The browser sent {value!r} instead of a number from -1 to 1.')
    return float(value)
