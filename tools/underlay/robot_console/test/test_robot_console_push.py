# SPDX-License-Identifier: Apache-2.0
"""The spring of the tool Push, how long its forces last, and when it lets go."""

from __future__ import annotations

from collections.abc import Callable
import math
from types import SimpleNamespace
from typing import Any

import pytest
from robot_console.push import Push, STILL, STILL_FRAMES
from robot_console.spring import Grip, Spring
from robot_console.wrench_link import Pulses, wrench_service
from rviz_common.canvas import Canvas
from rviz_common.frames import Pose
from rviz_common.selection import Hit, Ray, SceneObject
from rviz_common.tool import Drag

HALF = math.sqrt(0.5)
TURNED = Pose((1.0, 0.0, 0.0), (HALF, 0.0, 0.0, HALF))
"""The pose of a body a metre before the origin, which faces left."""
PUSHED = '/simulator/apply_wrench', ['robot_interfaces/srv/ApplyWrench']
RESET = '/simulator/reset_simulation', ['simulation_interfaces/srv/ResetSimulation']


def test_the_force_is_that_of_a_spring() -> None:
    """It grows with the distance up to the limit, and points to the pointer."""
    spring = Spring(100.0, 50.0)
    assert spring.force((1.0, 1.0, 1.0), (1.0, 1.2, 1.0)) == pytest.approx((0.0, 20.0, 0.0))
    assert spring.force((0.0, 0.0, 0.0), (3.0, 0.0, 4.0)) == pytest.approx((30.0, 0.0, 40.0))
    assert spring.force((1.0, 1.0, 1.0), (1.0, 1.0, 1.0)) == (0.0, 0.0, 0.0)


def test_the_grip_stays_at_the_body() -> None:
    """The point where the ray met the body moves with it; the pointer stays across the view."""
    ray = Ray((1.0, -5.0, 0.5), (0.0, 1.0, 0.0))
    grip = Grip.on(ray, 4.0, TURNED)
    assert grip.at == (1.0, -1.0, 0.5)
    assert grip.local == pytest.approx((-1.0, 0.0, 0.5))
    assert grip.point(TURNED) == pytest.approx(grip.at)
    assert grip.point(Pose((0.0, 0.0, 3.0))) == pytest.approx((-1.0, 0.0, 3.5))
    oblique = Ray.through((1.0, -5.0, 0.5), (3.0, -3.0, 0.5))
    assert grip.pointer(oblique) == pytest.approx((5.0, -1.0, 0.5))
    assert grip.pointer(Ray((1.0, -5.0, 0.5), (1.0, 0.0, 0.0))) is None
    assert grip.pointer(Ray((1.0, 5.0, 0.5), (0.0, 1.0, 0.0))) is None


def test_forces_last_as_long_as_time_has_passed() -> None:
    """Their durations add up to the simulated time; none is added while time stands still."""
    pulses = Pulses(10.0)
    assert [pulses.due(10.0), pulses.due(10.02)] == [0.0, 0.0]
    assert pulses.due(10.07) == pytest.approx(0.07)
    assert pulses.due(10.15) == pytest.approx(0.08)
    assert pulses.due(90.0) == Pulses.LONGEST_S
    assert pulses.due(1.0) == 0.0  # the simulator has started anew
    assert pulses.due(1.1) == pytest.approx(0.1)
    unknown = Pulses(None)
    assert [unknown.due(10.0), unknown.due(10.1)] == [0.0, pytest.approx(0.1)]


def test_the_simulator_says_whether_it_can_push() -> None:
    """Each reason why not is a sentence."""
    assert wrench_service([PUSHED, RESET], '', '') == ('/simulator', PUSHED[1][0])
    with pytest.raises(ValueError, match='No simulator is running'):
        wrench_service([PUSHED], '', '')
    with pytest.raises(ValueError, match="does not offer the service '/simulator/apply_wrench'"):
        wrench_service([RESET], '', '')
    two = [PUSHED, RESET, ('/b/reset_simulation', RESET[1])]
    with pytest.raises(ValueError, match="Name one in the property 'Simulator' of the tool"):
        wrench_service(two, '', '')
    assert wrench_service(two, '/simulator', '')[0] == '/simulator'


class Body(SceneObject):
    """A body that stays where it is."""

    name, frame = 'left_hand', 'left_hand'

    def __init__(self, entity: tuple[str, str] | None) -> None:
        """Begin in the scene."""
        self._entity = entity
        self.is_there = True

    @property
    def is_present(self) -> bool:
        """Whether it is there."""
        return self.is_there

    @property
    def entity(self) -> tuple[str, str] | None:
        """Its names for the simulator."""
        return self._entity

    def pose(self) -> Pose:
        """Return its pose."""
        return TURNED

    def details(self) -> list[tuple[str, str]]:
        """Return nothing."""
        return []

    def highlight(self, is_highlighted: bool) -> None:
        """Do nothing."""


class Link:
    """A simulator that takes notes."""

    def __init__(self, *_: Any) -> None:
        """Begin at 5 s."""
        self.problem, self.now_s = '', 5.0
        self.pushes: list[tuple[Any, ...]] = []
        self.asked: list[str] = []
        self.object_pose = Pose((1.0, 2.0, 3.0))
        self.is_closed = False

    def update(self) -> None:
        """Do nothing."""

    def push(self, *arguments: Any) -> None:
        """Note a force."""
        self.pushes.append(arguments)

    def ask_pose(self, entity: str, take: Callable[[Pose], None], failed: Any) -> None:
        """Answer at once."""
        self.asked.append(entity)
        take(self.object_pose)

    def close(self) -> None:
        """Note it."""
        self.is_closed = True


class Scene:
    """A page with one body, whose fixed frame faces left in the world of the simulator."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, entity: tuple[str, str] | None) -> None:
        """Take up the tool."""
        self.body = Body(entity)
        self.said: list[str] = []
        self.world: Pose | None = Pose(wxyz=(HALF, 0.0, 0.0, HALF))
        monkeypatch.setattr('robot_console.push.WrenchLink', Link)
        monkeypatch.setattr(Canvas, 'put', self.put)
        self.drawn: dict[str, Any] = {}
        context: Any = SimpleNamespace(
            scene=None,
            node=None,
            frames=SimpleNamespace(fixed_frame='odom', find=lambda target, source: self.world),
            visualizer=SimpleNamespace(
                selection=SimpleNamespace(pick=self.pick),
                notify=lambda title, text: self.said.append(text),
            ),
        )
        self.tool = Push(context, '/tool')
        self.tool.take_up()
        assert isinstance(self.tool._link, Link)
        self.link = self.tool._link

    def put(self, kind: str, name: str, **look: Any) -> None:
        """Note what is drawn."""
        self.drawn[name] = look

    def pick(self, ray: Ray) -> Hit | None:
        """Find the body a metre ahead of the eye, unless the ray points upwards."""
        return None if ray.direction[2] > 0.5 else Hit(4.0, self.body)

    def drag(self, x: float, is_over: bool = False, browser: int = 1) -> None:
        """Drag to a place beside the body, and draw a frame."""
        start = Ray((1.0, -5.0, 0.0), (0.0, 1.0, 0.0))
        now = Ray.through((1.0, -5.0, 0.0), (x, -1.0, 0.0))
        self.tool.drag_along(Drag(start, now, is_over, browser))
        self.frame()

    def frame(self) -> None:
        """Draw a frame, a tenth of a second later."""
        self.link.now_s += 0.1
        self.tool.update()


@pytest.fixture
def scene(monkeypatch: pytest.MonkeyPatch) -> Scene:
    """Return a scene with a link."""
    return Scene(monkeypatch, ('', 'left_hand'))


def test_a_link_is_pulled_until_the_button_is_released(scene: Scene) -> None:
    """The force is in the axes of the world, and takes hold where the pointer gripped."""
    scene.drag(1.2)
    entity, force_n, point, duration_s, _ = scene.link.pushes[0]
    assert entity == ('', 'left_hand')
    assert force_n == pytest.approx((0.0, 30.0, 0.0))
    assert point == pytest.approx((-1.0, 0.0, 0.0))
    assert duration_s == pytest.approx(0.1)
    assert scene.drawn['force']['text'] == '30 N'
    scene.drag(3.0)
    assert scene.link.pushes[1][1] == pytest.approx((0.0, 60.0, 0.0))
    assert scene.drawn['force']['text'] == '60 N (limit)'
    scene.drag(3.0, is_over=True)
    scene.frame()
    assert len(scene.link.pushes) == 2
    assert scene.said == []


def test_the_arrow_is_in_front_of_the_body(scene: Scene) -> None:
    """It is half a metre nearer to the viewer, who sees both of its ends where they are."""
    scene.drag(1.2)
    assert scene.drawn['arrow']['position'] == pytest.approx((1.0, -1.5, 0.0))
    assert scene.drawn['force']['position'] == pytest.approx((1.175, -1.5, 0.0))


def test_another_browser_cannot_take_over(scene: Scene) -> None:
    """Neither its movements nor its release have an effect."""
    scene.drag(1.2)
    scene.drag(3.0, browser=2)
    scene.drag(3.0, is_over=True, browser=2)
    assert [push[1] for push in scene.link.pushes] == [pytest.approx((0.0, 30.0, 0.0))] * 3
    scene.drag(3.0, browser=2)
    scene.drag(1.2, is_over=True)
    scene.drag(3.0, browser=2)
    assert scene.tool._pull is None


def test_objects_are_gripped_where_the_simulator_has_them(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A marker may be a part of the object; the spring is a weak one."""
    scene = Scene(monkeypatch, ('mug', ''))
    scene.drag(1.2)
    assert scene.link.asked == ['mug']
    entity, force_n, point, _, _ = scene.link.pushes[0]
    assert entity == ('mug', '')
    assert force_n == pytest.approx((0.0, 2.0, 0.0))
    # The grip at (1, -1, 0) is at (1, 1, 0) in the world, and the mug at (1, 2, 3).
    assert point == pytest.approx((0.0, -1.0, -3.0))


@pytest.mark.parametrize(
    ('break_it', 'sentence'),
    [
        (lambda scene: setattr(scene.link, 'problem', 'Gone.'), 'Gone.'),
        (lambda scene: setattr(scene.body, 'is_there', False), "'left_hand' is no longer shown."),
        (lambda scene: setattr(scene, 'world', None), r'No transform from [odom] to [world]'),
        (lambda scene: scene.link.pushes[0][-1]('No such body.'), 'No such body.'),
    ],
)
def test_a_pull_that_breaks_says_why(
    scene: Scene, break_it: Callable[[Scene], None], sentence: str
) -> None:
    """The rest of the drag does nothing; the next one is a new one."""
    scene.drag(1.2)
    break_it(scene)
    scene.frame()
    count = len(scene.link.pushes)
    scene.drag(3.0)
    assert len(scene.link.pushes) == count
    assert len(scene.said) == 1 and sentence in scene.said[0]
    scene.link.problem, scene.body.is_there, scene.world = '', True, Pose()
    scene.drag(3.0, is_over=True)
    scene.drag(1.2)
    assert len(scene.link.pushes) == count + 1


def test_what_cannot_be_pushed_is_said_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """A drag beside everything is nothing to talk about."""
    scene = Scene(monkeypatch, None)
    up = Ray((0.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    scene.tool.drag_along(Drag(up, up, False, 1))
    scene.tool.drag_along(Drag(up, up, True, 1))
    assert scene.said == []
    scene.drag(1.2)
    scene.drag(1.3)
    assert scene.said == ["'left_hand' cannot be pushed: the simulator does not know it."]


def test_a_paused_simulation_is_said(scene: Scene) -> None:
    """While simulated time stands still, a force would only wait, and act when nobody pushes."""
    start = Ray((1.0, -5.0, 0.0), (0.0, 1.0, 0.0))
    scene.tool.drag_along(Drag(start, start, False, 1))
    for _ in range(2 * STILL_FRAMES):
        scene.tool.update()
    assert scene.said == [STILL]
    assert scene.link.pushes == []
    scene.frame()
    assert len(scene.link.pushes) == 1


def test_laying_the_tool_down_ends_the_pull(scene: Scene) -> None:
    """The simulator is forgotten, too."""
    scene.drag(1.2)
    scene.tool.lay_down()
    scene.frame()
    assert scene.link.is_closed and len(scene.link.pushes) == 1


def test_a_drag_without_an_end_does_not_spoil_the_next(scene: Scene) -> None:
    """Another tool may have been activated before the button was released."""
    up, start = Ray((0.0, 0.0, 0.0), (0.0, 0.0, 1.0)), Ray((1.0, -5.0, 0.0), (0.0, 1.0, 0.0))
    scene.tool.drag_along(Drag(up, up, False, 1))
    scene.tool.lay_down()
    scene.tool.take_up()
    scene.tool.drag_along(Drag(start, start, False, 1))
    assert scene.tool._pull is not None


def test_a_late_answer_does_not_end_the_next_pull(scene: Scene) -> None:
    """It is about a force of the pull before."""
    scene.drag(1.2)
    scene.drag(1.2, is_over=True)
    scene.drag(1.3)
    scene.link.pushes[0][-1]('No such body.')
    assert scene.said == [] and scene.tool._pull is not None
