# SPDX-License-Identifier: Apache-2.0
"""The tools of a file, one of which may be active and gets the clicks and drags."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Mapping, Sequence
import copy
from dataclasses import replace
from typing import Any

from rviz_common.context import Context
from rviz_common.frames import WORLD
from rviz_common.page.watchdog import wait_until_lost
from rviz_common.plugins import load_plugin, TOOLS
from rviz_common.selection import Ray
from rviz_common.status import described_error
from rviz_common.tool import Drag, ObjectTool, Point, Tool

__all__ = ['BUILT_IN', 'ToolBox', 'ground_point']

BUILT_IN = tuple(
    f'rviz_default_plugins/{name}'
    for name in ('Interact', 'MoveCamera', 'FocusCamera', 'ZoomTool', 'FPSMotion')
)
"""Tools of RViz that a browser has built in, or that do not apply there."""

SIZE_M = 2000.0
THICKNESS_M = 1e-4
FARTHEST_M = 1e5


class ToolBox:
    """
    The tools of a file, one of which may be active; other entries are preserved for the file.

    Parameters
    ----------
    context
        The context of the tools.
    origin
        Returns the position of the camera's target frame, in m in the fixed frame.
    entries
        The entries of the section `Tools` of the file.

    Attributes
    ----------
    in_use
        The active tool, if any.
    failures
        The classes that cannot be imported, with the errors.

    """

    def __init__(
        self,
        context: Context,
        origin: Callable[[], Point],
        entries: Sequence[Mapping[str, Any]],
    ) -> None:
        self._logger = context.node.get_logger()
        self.failures: dict[str, str] = {}
        self._entries: list[Tool | Mapping[str, Any]] = [
            self._made(context, f'{WORLD}/tools/{number}', entry)
            for number, entry in enumerate(entries)
        ]
        self._pointer = _Pointer(context, origin, self._click, self._drag)
        self.in_use: Tool | None = None
        for tool in self.tools:
            tool.begin()

    @property
    def tools(self) -> list[Tool]:
        """The tools of known classes."""
        return [each for each in self._entries if isinstance(each, Tool)]

    @property
    def unknown(self) -> list[str]:
        """The classes of the entries that are unknown."""
        classes = [entry['Class'] for entry in self._entries if not isinstance(entry, Tool)]
        return [each for each in classes if each not in BUILT_IN]

    def use(self, tool: Tool | None) -> None:
        """
        Activate a tool, and deactivate the previous one.

        Parameters
        ----------
        tool
            One of `tools`; None for none, so that the pointer turns the scene.

        """
        if self.in_use is not None:
            self.in_use.lay_down()
        self.in_use = tool
        if tool is not None:
            tool.take_up()
        self._pointer.watch(tool)

    def update(self) -> None:
        """Draw the next frame of the active tool."""
        self._pass_on(_updated)

    def to_file(self) -> list[dict[str, Any]]:
        """Return the entry for the .rviz file."""
        return [
            each.to_file() if isinstance(each, Tool) else copy.deepcopy(dict(each))
            for each in self._entries
        ]

    def close(self) -> None:
        """Close all tools."""
        self.use(None)
        for tool in self.tools:
            tool.close()

    def _made(
        self, context: Context, root: str, entry: Mapping[str, Any]
    ) -> Tool | Mapping[str, Any]:
        try:
            tool: Tool = load_plugin(TOOLS, entry['Class'])(context, root, entry)
        except LookupError:
            return entry
        except ImportError as error:
            self.failures[entry['Class']] = str(error)
            return entry
        return tool

    def _click(self, ray: Ray, browser: int) -> None:
        self._pass_on(lambda tool: _clicked(tool, ray, browser))

    def _drag(self, drag: Drag) -> None:
        self._pass_on(lambda tool: _dragged(tool, drag))

    def _pass_on(self, work: Callable[[Tool], bool]) -> None:
        """Run a callable of the active tool; deactivate the tool when it is done or fails."""
        tool = self.in_use
        if tool is None:
            return
        try:
            is_done = work(tool)
        except Exception as error:  # a failing tool must not stop anything else
            self._logger.error(f"Tool '{tool.NAME}' failed: {described_error(error)}")
            is_done = True
        if is_done:
            self.use(None)


def _updated(tool: Tool) -> bool:
    tool.update()
    return False


def _clicked(tool: Tool, ray: Ray, browser: int) -> bool:
    """Pass a click in a browser on to a tool; return whether the tool is done."""
    tool.browser = browser
    if isinstance(tool, ObjectTool):
        return tool.click_along(ray)
    point = ground_point(ray.origin, ray.direction)
    return False if point is None else tool.click(point)


def _dragged(tool: Tool, drag: Drag) -> bool:
    """Pass a drag on to a tool; return whether the tool is done."""
    tool.browser = drag.browser
    if isinstance(tool, ObjectTool):
        return tool.drag_along(drag)
    start, end = (ground_point(ray.origin, ray.direction) for ray in (drag.start, drag.now))
    return False if start is None else tool.drag(start, end or start, drag.is_over)


class _Pointer:
    """
    Reports clicks anywhere in the scene, and drags on an invisible body, as the tool needs them.

    The body is a plane below the scene, or a box around it. It is only present while a tool is
    active that takes drags; otherwise a drag turns the scene. A drag in the box also ends when
    the browser no longer answers.

    Parameters
    ----------
    context
        The page, and the queue that transfers calls to the node's thread.
    origin
        Returns the position of the camera's target frame, in m in the fixed frame.
    click
        Called with the ray of a click, and the number of the browser.
    drag
        Called for each movement of a drag.

    """

    def __init__(
        self,
        context: Context,
        origin: Callable[[], Point],
        click: Callable[[Ray, int], None],
        drag: Callable[[Drag], None],
    ) -> None:
        self._context = context
        self._origin = origin
        self._click = click
        self._drag = drag
        self._body: Any = None
        self._is_around = self._hears_clicks = False
        self._watchdogs: dict[int, asyncio.Task[None]] = {}
        self._scene: Any = context.scene

    def watch(self, tool: Tool | None) -> None:
        """
        Report what a tool needs from now on.

        Parameters
        ----------
        tool
            The active tool, None for none.

        """
        if self._body is not None:
            self._body.remove()
            self._body = None
        if tool is not None and (not isinstance(tool, ObjectTool) or tool.TAKES_DRAGS):
            self._is_around = isinstance(tool, ObjectTool)
            self._body = self._add()
        if self._hears_clicks != (tool is not None):
            self._hears_clicks = tool is not None
            if self._hears_clicks:
                # Not of the body: viser highlights clickable nodes under the pointer.
                self._scene.on_click()(self._on_click)
            else:
                self._scene.remove_click_callback(self._on_click)

    def _add(self) -> Any:
        body = self._scene.add_box(
            f'{WORLD}/ground',
            dimensions=(SIZE_M, SIZE_M, SIZE_M if self._is_around else THICKNESS_M),
            opacity=0.0,
            side='double' if self._is_around else 'front',
            cast_shadow=False,
            receive_shadow=False,
        )
        body.on_drag('left')(self._on_drag)
        return body

    # Callbacks of viser keep their order only if they are coroutines.

    async def _on_click(self, event: Any) -> None:
        ray = Ray(self._moved(event.ray_origin), _floats(event.ray_direction))
        self._context.queue.post(lambda: self._click(ray, event.client_id))

    async def _on_drag(self, event: Any) -> None:
        eye = self._moved(event.client.camera.position)
        start, now = (
            Ray.through(eye, self._moved(position))
            for position in (event.start_position, event.end_position)
        )
        drag = Drag(start, now, event.phase == 'end', event.client_id)
        body = self._body
        if not self._is_around or self._is_watched(drag, event.phase == 'start', body):
            self._context.queue.post(lambda: self._pass_on(drag, body))

    def _pass_on(self, drag: Drag, body: Any) -> None:
        """Report a drag, unless another tool is active by now, for which it would be a command."""
        if body is not None and body is self._body:
            self._drag(drag)

    def _is_watched(self, drag: Drag, is_start: bool, body: Any) -> bool:
        """Watch the browser of a drag; return False if the drag has been ended, as it was lost."""
        before = self._watchdogs.get(drag.browser)
        if before is not None and (is_start or drag.is_over):
            before.cancel()
            del self._watchdogs[drag.browser]
        if is_start:
            watchdog = asyncio.create_task(self._end_when_lost(drag, body))
            self._watchdogs[drag.browser] = watchdog
        return is_start or before is not None

    async def _end_when_lost(self, drag: Drag, body: Any) -> None:
        await wait_until_lost()
        del self._watchdogs[drag.browser]
        self._context.queue.post(lambda: self._pass_on(replace(drag, is_over=True), body))

    def _moved(self, point: Sequence[float]) -> Point:
        """Convert a point of the scene, which follows the target frame, to the fixed frame."""
        x, y, z = (float(part) + offset for part, offset in zip(point, self._origin()))
        return x, y, z


def _floats(vector: Sequence[float]) -> Point:
    x, y, z = (float(part) for part in vector)
    return x, y, z


def ground_point(origin: Sequence[float], direction: Sequence[float]) -> Point | None:
    """
    Intersect a ray with the ground, the plane z = 0.

    Parameters
    ----------
    origin
        The start of the ray, in m.
    direction
        Its direction, of any length.

    Returns
    -------
    Point | None
        None if the ray does not intersect the plane, or only beyond 100 km in x or y.

    """
    if abs(direction[2]) < 1e-9:
        return None
    length = -origin[2] / direction[2]
    x, y = (float(origin[i] + length * direction[i]) for i in (0, 1))
    if length < 0.0 or not max(abs(x), abs(y)) < FARTHEST_M:
        return None
    return x, y, 0.0
