# SPDX-License-Identifier: Apache-2.0
"""The tools of a file, one of which may be active and gets the clicks and drags on the ground."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
import copy
from typing import Any

from rviz_common.context import Context
from rviz_common.plugins import load_plugin, TOOLS
from rviz_common.status import described_error
from rviz_common.tool import Point, Tool
from rviz_common.view import WORLD

__all__ = ['BUILT_IN', 'ToolBox', 'ground_point']

BUILT_IN = tuple(
    f'rviz_default_plugins/{name}'
    for name in ('Interact', 'MoveCamera', 'Select', 'FocusCamera', 'ZoomTool', 'FPSMotion')
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
        self._ground = _Ground(context, origin, self._click, self._drag)
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
        self._ground.watch(tool is not None)

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

    def _click(self, point: Point) -> None:
        self._pass_on(lambda tool: tool.click(point))

    def _drag(self, start: Point, end: Point, is_over: bool) -> None:
        self._pass_on(lambda tool: tool.drag(start, end, is_over))

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


class _Ground:
    """
    An invisible plane below the scene, which reports clicks and drags.

    It is only present while a tool is active; otherwise a drag turns the scene.

    Parameters
    ----------
    context
        The page, and the queue that transfers calls to the node's thread.
    origin
        Returns the position of the camera's target frame, in m in the fixed frame.
    click
        Called with the point of a click, in m in the fixed frame.
    drag
        Called for each movement of a drag with its start, current point, and whether it is over.

    """

    def __init__(
        self,
        context: Context,
        origin: Callable[[], Point],
        click: Callable[[Point], None],
        drag: Callable[[Point, Point, bool], None],
    ) -> None:
        self._context = context
        self._origin = origin
        self._click = click
        self._drag = drag
        self._plane: Any = None
        self._scene: Any = context.scene

    def watch(self, is_wanted: bool) -> None:
        """
        Add or remove the plane, which enables or disables reports of clicks and drags.

        Parameters
        ----------
        is_wanted
            Whether clicks and drags are to be reported from now on.

        """
        if is_wanted and self._plane is None:
            self._plane = self._add()
            # Not of the plane: viser highlights clickable nodes under the pointer.
            self._scene.on_click()(self._on_click)
        elif not is_wanted and self._plane is not None:
            self._scene.remove_click_callback(self._on_click)
            self._plane.remove()
            self._plane = None

    def _add(self) -> Any:
        plane = self._scene.add_box(
            f'{WORLD}/ground',
            dimensions=(SIZE_M, SIZE_M, THICKNESS_M),
            opacity=0.0,
            cast_shadow=False,
            receive_shadow=False,
        )
        plane.on_drag('left')(self._on_drag)
        return plane

    # Callbacks of viser keep their order only if they are coroutines.

    async def _on_click(self, event: Any) -> None:
        point = self._point(event.ray_origin, event.ray_direction)
        if point is not None:
            self._context.queue.post(lambda: self._click(point))

    async def _on_drag(self, event: Any) -> None:
        eye = tuple(float(part) for part in event.client.camera.position)
        start, end = (
            self._point(eye, [b - a for a, b in zip(eye, position)])
            for position in (event.start_position, event.end_position)
        )
        is_over = event.phase == 'end'
        if start is not None:
            self._context.queue.post(lambda: self._drag(start, end or start, is_over))

    def _point(self, origin: Sequence[float], direction: Sequence[float]) -> Point | None:
        """Return the intersection of a ray of the scene with the ground, in the fixed frame."""
        moved = [part + offset for part, offset in zip(origin, self._origin())]
        return ground_point(moved, direction)


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
