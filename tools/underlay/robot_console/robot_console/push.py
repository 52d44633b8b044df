# SPDX-License-Identifier: Apache-2.0
"""The tool that pulls a link of the robot, or an object, in simulation."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
import math
from typing import Any

from robot_console.namespaces import NAMESPACE
from robot_console.spring import Grip, Spring
from robot_console.wrench_link import Pulses, WrenchLink
from rviz_common.canvas import Canvas
from rviz_common.context import Context
from rviz_common.frames import Pose
from rviz_common.properties import Number, Text
from rviz_common.selection import Hit, Point, SceneObject
from rviz_common.tool import Drag, ObjectTool
from rviz_default_plugins.bodies import add_arrow_to, Paint

__all__ = ['Push']

WIDTH_M = 0.02
PAINT: Paint = (255, 130, 20), 1.0
STILL = 'The simulated time stands still, so that a push has no effect: press Play.'
STILL_FRAMES = 60
IN_FRONT_M = 0.5
"""How far before the grip the arrow is drawn, on the lines of sight, so that no body hides it."""


@dataclass
class _Pull:
    """What is being pulled, by whom, and how."""

    browser: int
    found: SceneObject
    grip: Grip
    spring: Spring
    target: Point
    pulses: Pulses
    eye: Point
    """Where the viewer who pulls looks from."""
    body_point: Point | None
    """Where the force takes hold in the frame of the simulated body; None until it is known."""


class Push(ObjectTool):
    """
    Tool that pulls a link of a robot, or an object, towards the pointer, in simulation.

    The force is that of a spring. It ends when the button is released, the page is closed, or the
    connection to it is lost.

    Parameters
    ----------
    context, root, given
        As for `Tool`.

    """

    CLASS = 'robot_console/Push'
    NAME = 'Push'
    HINT = (
        'Press on a link of the robot or on an object, and drag: a spring pulls it towards the '
        'pointer until you release. To turn the view, use the wheel and the right button, or '
        'choose Move Camera.'
    )
    TAKES_DRAGS = True
    PROPERTIES = (
        Number('Stiffness', 150.0, 'Of the spring at links of robots, in N/m.', 0.0, 1e5),
        Number('Largest Force', 60.0, 'On links of robots, in N.', 0.0, 1e5),
        Number('Object Stiffness', 10.0, 'Of the spring at objects, in N/m.', 0.0, 1e5),
        Number('Object Largest Force', 10.0, 'On objects, in N.', 0.0, 1e5),
        Text('World Frame', 'world', 'The frame of the simulator in tf.'),
        Text('Simulator', '', 'The node of the simulator, if there are several.'),
        NAMESPACE,
    )

    def __init__(
        self, context: Context, root: str, given: Mapping[str, Any] | None = None
    ) -> None:
        super().__init__(context, root, given)
        self._canvas = Canvas(self.context.scene, self.root)
        self._link: WrenchLink | None = None
        self._pull: _Pull | None = None
        self._ignored: set[int] = set()
        self._still_frames = 0

    def take_up(self) -> None:
        """Look for the simulator."""
        self._link = WrenchLink(
            self.context.node, self.values['Simulator'], self.values[NAMESPACE.path]
        )
        self._link.update()
        if self._link.problem:
            self._say(self._link.problem)

    def lay_down(self) -> None:
        """Release what is pulled, and forget the simulator, and drags that were ignored."""
        self._release()
        self._ignored.clear()
        if self._link is not None:
            self._link.close()
            self._link = None

    def on_change(self, path: str) -> None:
        """
        Apply a property that was changed.

        Parameters
        ----------
        path
            As for `Tool.on_change`.

        """
        if self._link is not None:
            self.lay_down()
            self.take_up()

    def drag_along(self, drag: Drag) -> bool:
        """
        Grip what is under the pointer, pull it, and release it.

        Parameters
        ----------
        drag
            As for `ObjectTool.drag_along`.

        """
        if self._pull is None and drag.browser not in self._ignored and not drag.is_over:
            self._grip(drag)
        pull = self._pull
        if pull is not None and pull.browser != drag.browser:
            self._ignored.add(drag.browser)
        if pull is not None and pull.browser == drag.browser:
            pull.target = pull.grip.pointer(drag.now) or pull.target
            pull.eye = drag.now.origin
            if drag.is_over:
                self._release()
        if drag.is_over:
            self._ignored.discard(drag.browser)
        return False

    def update(self) -> None:
        """Apply the force, and draw it."""
        link, pull = self._link, self._pull
        if link is None:
            return
        link.update()
        if pull is None:
            return
        pose = pull.found.pose() if pull.found.is_present else None
        frames = self.context.frames
        world = frames.find(self.values['World Frame'], frames.fixed_frame)
        if link.problem:
            self._fail(pull, link.problem)
        elif pose is None:
            self._fail(pull, f"'{pull.found.name}' is no longer shown.")
        elif world is None:
            self._fail(
                pull,
                f'No transform from [{frames.fixed_frame}] to [{self.values["World Frame"]}], '
                "which the property 'World Frame' of the tool names as that of the simulator.",
            )
        else:
            at = pull.grip.point(pose)
            force_n = pull.spring.force(at, pull.target)
            self._show(at, pull, force_n)
            self._apply(link, pull, Pose(wxyz=world.wxyz).of(Pose(force_n)).position)

    def _grip(self, drag: Drag) -> None:
        """Begin to pull what the drag began on, or say why not."""
        self._ignored.add(drag.browser)
        hit = self.context.visualizer.selection.pick(drag.start)
        link = self._link
        if hit is None or link is None:
            return
        if link.problem:
            self._say(link.problem)
            return
        found = hit.found.rigid_body()
        pose, entity = found.pose(), found.entity
        if pose is None or entity is None:
            self._say(f"'{hit.found.name}' cannot be pushed: the simulator does not know it.")
            return
        self._ignored.discard(drag.browser)
        self._pull = self._begun(drag, hit, found, pose, Pulses(link.now_s))
        if entity[1]:
            self._pull.body_point = self._pull.grip.local
        else:
            self._ask_for_object(link, self._pull, entity[0])

    def _begun(
        self, drag: Drag, hit: Hit, found: SceneObject, pose: Pose, pulses: Pulses
    ) -> _Pull:
        kind = '' if found.entity and found.entity[1] else 'Object '
        spring = Spring(self.values[f'{kind}Stiffness'], self.values[f'{kind}Largest Force'])
        grip = Grip.on(drag.start, hit.distance, pose)
        return _Pull(drag.browser, found, grip, spring, grip.at, pulses, drag.now.origin, None)

    def _ask_for_object(self, link: WrenchLink, pull: _Pull, entity: str) -> None:
        """Ask where the object is: a marker may be a part of it, with a pose of its own."""
        frames = self.context.frames
        world = frames.find(self.values['World Frame'], frames.fixed_frame) or Pose()
        at = world.of(Pose(pull.grip.at))

        def take(pose: Pose) -> None:
            pull.body_point = pose.inverse().of(at).position

        link.ask_pose(entity, take, lambda reason: self._fail(pull, reason))

    def _apply(self, link: WrenchLink, pull: _Pull, force_n: Point) -> None:
        """Renew the force, as simulated time goes on."""
        point, entity = pull.body_point, pull.found.entity
        if point is None or entity is None:
            return
        duration_s = 0.0 if link.now_s is None else pull.pulses.due(link.now_s)
        self._still_frames = 0 if duration_s else self._still_frames + 1
        if self._still_frames == STILL_FRAMES:
            self._say(STILL)
        if duration_s:
            link.push(entity, force_n, point, duration_s, lambda reason: self._fail(pull, reason))

    def _show(self, at: Point, pull: _Pull, force_n: Point) -> None:
        """
        Draw the spring as an arrow, with the force in N.

        The viewer who pulls sees the arrow where the spring is, though nearer and smaller.
        """
        size_n = math.hypot(*force_n)
        scale = max(0.5, 1.0 - IN_FRONT_M / max(math.dist(pull.eye, at), 1e-9))
        start, tip = (_scaled(pull.eye, point, scale) for point in (at, pull.target))
        x, y, z = (b - a for a, b in zip(start, tip))
        is_limited = size_n > 0.999 * pull.spring.limit_n
        with self._canvas.anew():
            add_arrow_to(self._canvas, 'arrow', (x, y, z), scale * WIDTH_M, PAINT, start)
            self._canvas.put(
                'label',
                'force',
                text=f'{size_n:.0f} N{" (limit)" if is_limited else ""}',
                position=tip,
            )

    def _release(self) -> None:
        self._pull = None
        self._still_frames = 0
        with self._canvas.anew():
            pass

    def _fail(self, pull: _Pull, reason: str) -> None:
        """End a pull that is not yet over, and say why; the rest of its drag is ignored."""
        if self._pull is pull:
            self._ignored.add(pull.browser)
            self._release()
            self._say(reason)

    def _say(self, sentence: str) -> None:
        self.context.visualizer.notify(self.NAME, sentence)


def _scaled(eye: Point, point: Point, scale: float) -> Point:
    """Move a point towards the eye, to a part of its distance."""
    x, y, z = (a + scale * (b - a) for a, b in zip(eye, point))
    return x, y, z
