# SPDX-License-Identifier: Apache-2.0
"""Tests of where the pointer is, which tool is in use, and what it gets."""

import asyncio
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import pytest
from rviz_common.selection import Ray
from rviz_common.tool import Drag, ObjectTool, Point, Tool
from rviz_common.visualizer import Visualizer
from rviz_common.visualizer.tool_box import ground_point, ToolBox

Show = Callable[..., Visualizer]


class Probe(Tool):
    """A tool that remembers, and is done after a click."""

    CLASS = 'test/Probe'
    NAME = 'Probe'
    HINT = 'Probe.'

    def __init__(self, *given: Any) -> None:
        """Begin with nothing."""
        super().__init__(*given)
        self.said: list[Any] = []

    def take_up(self) -> None:
        """Say so."""
        self.said.append('up')

    def lay_down(self) -> None:
        """Say so."""
        self.said.append('down')

    def click(self, point: Point) -> bool:
        """Say where."""
        self.said.append(point)
        return True

    def drag(self, start: Point, end: Point, is_over: bool) -> bool:
        """Fail."""
        raise RuntimeError('no drag')


class ObjectProbe(ObjectTool):
    """A tool for objects that remembers."""

    CLASS = 'test/ObjectProbe'
    NAME = 'Object Probe'
    HINT = 'Probe objects.'
    TAKES_DRAGS = True

    def __init__(self, *given: Any) -> None:
        """Begin with nothing."""
        super().__init__(*given)
        self.rays: list[Ray] = []
        self.drags: list[Drag] = []
        self.frames = 0

    def click_along(self, ray: Ray) -> bool:
        """Remember the ray."""
        self.rays.append(ray)
        return False

    def drag_along(self, drag: Drag) -> bool:
        """Remember the drag."""
        self.drags.append(drag)
        return drag.is_over

    def update(self) -> None:
        """Count the frames."""
        self.frames += 1


@pytest.fixture
def shown(show: Show, monkeypatch: pytest.MonkeyPatch) -> Visualizer:
    """Show a file with two tools of the test, one that is not known and one of browsers."""
    monkeypatch.setattr(
        'rviz_common.visualizer.tool_box.load_plugin', lambda group, name: {'a/P': Probe}[name]
    )
    manager = 'Visualization Manager:\n  Tools:\n'
    entries = ('a/P', 'a/P', 'x/Y', 'rviz_default_plugins/MoveCamera')
    return show(manager + ''.join(f'    - Class: {name}\n' for name in entries))


def said(tool: Tool | None) -> list[Any]:
    """Return what a tool of the test remembers."""
    assert isinstance(tool, Probe)
    return tool.said


def test_one_tool_is_in_use(shown: Visualizer) -> None:
    """Who takes another one lays the last one down; the plane is there only for tools."""
    box = shown.tools
    first, second = box.tools
    scene = shown.context.scene
    assert scene.get_handle_by_name('/world/ground') is None
    box.use(first)
    assert scene.get_handle_by_name('/world/ground') is not None
    box.use(second)
    assert said(first) == ['up', 'down'] and said(second) == ['up']
    box.use(None)
    assert said(second) == ['up', 'down']
    assert scene.get_handle_by_name('/world/ground') is None
    assert box.unknown == ['x/Y']
    assert [each['Class'] for each in box.to_file()][2:] == [
        'x/Y',
        'rviz_default_plugins/MoveCamera',
    ]


def test_clicks_reach_the_tool_in_the_thread_of_the_node(shown: Visualizer) -> None:
    """The callback only posts; the point is in the fixed frame, wherever the camera is."""
    box: ToolBox = shown.tools
    tool = box.tools[0]
    box.use(tool)
    shown.cameras._at = (10.0, 20.0, 0.0)
    event = SimpleNamespace(
        ray_origin=(0.0, 0.0, 2.0), ray_direction=(0.5, 0.0, -1.0), client_id=7
    )
    asyncio.run(box._pointer._on_click(event))
    assert said(tool) == ['up']
    shown.context.queue.run()
    assert said(tool) == ['up', (11.0, 20.0, 0.0), 'down']
    assert tool.browser == 7
    assert box.in_use is None


def test_a_tool_that_fails_is_laid_down(shown: Visualizer, capfd: Any) -> None:
    """The log says why."""
    tool = shown.tools.tools[0]
    shown.tools.use(tool)
    camera = SimpleNamespace(position=(0.0, 0.0, 4.0))
    event = SimpleNamespace(
        client=SimpleNamespace(camera=camera),
        start_position=(1.0, 0.0, 0.0),
        end_position=(1.0, 1.0, 2.0),
        phase='update',
        client_id=0,
    )
    asyncio.run(shown.tools._pointer._on_drag(event))
    shown.context.queue.run()
    assert shown.tools.in_use is None
    assert "Tool 'Probe' failed: " in capfd.readouterr().err


@pytest.mark.parametrize(
    ('origin', 'direction', 'point'),
    [
        ((0, 0, 2), (0.5, 0, -1), (1.0, 0.0, 0.0)),
        ((0, 0, 2), (0.5, 0, 1), None),  # towards the sky
        ((0, 0, 2), (1, 0, 0), None),  # along the horizon
        ((0, 0, 2), (1, 0, -1e-7), None),  # farther than anything
        ((0, 0, 2), (float('nan'), 0, -1), None),
        ((3, 1, -2), (0, 0, 1), (3.0, 1.0, 0.0)),  # from below
    ],
)
def test_rays_meet_the_ground(origin: Any, direction: Any, point: Point | None) -> None:
    """A ray that goes up, or nearly along the ground, is nowhere."""
    assert ground_point(origin, direction) == point


@pytest.fixture
def probe(show: Show, monkeypatch: pytest.MonkeyPatch) -> tuple[Visualizer, ObjectProbe]:
    """Show a file with a tool for objects, which is active."""
    monkeypatch.setattr(
        'rviz_common.visualizer.tool_box.load_plugin', lambda group, name: ObjectProbe
    )
    shown = show('Visualization Manager:\n  Tools:\n    - Class: a/O\n')
    (tool,) = shown.tools.tools
    assert isinstance(tool, ObjectProbe)
    shown.tools.use(tool)
    return shown, tool


def test_tools_for_objects_get_rays(probe: tuple[Visualizer, ObjectProbe]) -> None:
    """Also towards the sky; in the fixed frame, wherever the camera is."""
    shown, tool = probe
    shown.cameras._at = (10.0, 0.0, 0.0)
    click = SimpleNamespace(ray_origin=(0.0, 0.0, 2.0), ray_direction=(0.0, 0.0, 1.0), client_id=6)
    asyncio.run(shown.tools._pointer._on_click(click))
    drag = SimpleNamespace(
        client=SimpleNamespace(camera=SimpleNamespace(position=(0.0, 0.0, 2.0))),
        start_position=(0.0, 3.0, 2.0),
        end_position=(5.0, 0.0, 2.0),
        phase='start',
        client_id=7,
    )
    asyncio.run(shown.tools._pointer._on_drag(drag))
    shown.context.queue.run()
    eye = (10.0, 0.0, 2.0)
    assert tool.rays == [Ray(eye, (0.0, 0.0, 1.0))]
    assert tool.drags == [Drag(Ray(eye, (0.0, 1.0, 0.0)), Ray(eye, (1.0, 0.0, 0.0)), False, 7)]
    assert tool.browser == 7


def test_drags_turn_the_scene_unless_the_tool_takes_them(
    probe: tuple[Visualizer, ObjectProbe], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nothing invisible is in the way of the pointer for a tool that is for clicks only."""
    shown, tool = probe
    body: Any = shown.context.scene.get_handle_by_name('/world/ground')
    assert min(body.dimensions) > 1000.0 and body.side == 'double'
    shown.frame()
    assert tool.frames == 1
    monkeypatch.setattr(ObjectProbe, 'TAKES_DRAGS', False)
    shown.tools.use(tool)
    assert shown.context.scene.get_handle_by_name('/world/ground') is None
    assert tool.frames == 1


def test_a_drag_ends_when_the_browser_no_longer_answers(
    probe: tuple[Visualizer, ObjectProbe], monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is not taken up again when the browser is back; a new one is."""
    shown, tool = probe
    lost: list[asyncio.Event] = []

    async def wait_until_lost() -> None:
        lost.append(asyncio.Event())
        await lost[-1].wait()

    async def drag(phase: str) -> None:
        event = SimpleNamespace(
            client=SimpleNamespace(camera=SimpleNamespace(position=(0.0, 0.0, 2.0))),
            start_position=(0.0, 3.0, 2.0),
            end_position=(5.0, 0.0, 2.0),
            phase=phase,
            client_id=7,
        )
        await shown.tools._pointer._on_drag(event)
        await asyncio.sleep(0.0)

    async def main() -> None:
        for phase in ('start', 'update', 'end', 'start', 'update'):
            await drag(phase)
        lost[-1].set()
        await asyncio.wait(shown.tools._pointer._watchdogs.values())
        for phase in ('update', 'end', 'start'):
            await drag(phase)

    monkeypatch.setattr('rviz_common.visualizer.tool_box.wait_until_lost', wait_until_lost)
    monkeypatch.setattr(ObjectProbe, 'drag_along', lambda tool, drag: tool.drags.append(drag))
    asyncio.run(main())
    shown.context.queue.run()
    assert [drag.is_over for drag in tool.drags] == [False, False, True] * 2 + [False]


def test_a_lost_browser_does_not_end_a_drag_of_another_tool(
    probe: tuple[Visualizer, ObjectProbe], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The end of a drag is a command for some tools, such as to send a robot to a place."""
    shown, tool = probe
    lost = asyncio.Event()
    event = SimpleNamespace(
        client=SimpleNamespace(camera=SimpleNamespace(position=(0.0, 0.0, 2.0))),
        start_position=(0.0, 3.0, 2.0),
        end_position=(5.0, 0.0, 2.0),
        phase='start',
        client_id=7,
    )

    async def main() -> None:
        await shown.tools._pointer._on_drag(event)
        await asyncio.sleep(0.0)
        shown.context.queue.run()
        shown.tools.use(None)
        shown.tools.use(tool)
        lost.set()
        await asyncio.wait(shown.tools._pointer._watchdogs.values())

    monkeypatch.setattr('rviz_common.visualizer.tool_box.wait_until_lost', lost.wait)
    asyncio.run(main())
    shown.context.queue.run()
    assert [drag.is_over for drag in tool.drags] == [False]
    assert shown.tools.in_use is tool
