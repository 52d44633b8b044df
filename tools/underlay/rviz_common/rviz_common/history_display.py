# SPDX-License-Identifier: Apache-2.0
"""A display of the last messages of a topic, each where its frame was at its time."""

from __future__ import annotations

from collections import deque
import time
from typing import Any, ClassVar, NamedTuple

from rviz_common.canvas import Canvas
from rviz_common.frames import FrameError, Pose
from rviz_common.status import Level
from rviz_common.topic_display import TopicDisplay

__all__ = ['HistoryDisplay']


class Waiting(NamedTuple):
    """A message, and when it came in nanoseconds of the node's clock."""

    message: Any
    came_ns: int


class Place(NamedTuple):
    """A node of the scene, and what is drawn below it."""

    node: Any
    canvas: Canvas


class Kept(NamedTuple):
    """A message that is drawn, and where."""

    waiting: Waiting
    place: Place


class HistoryDisplay(TopicDisplay):
    """
    A display of the last messages of a topic.

    Each stays in the fixed frame where its own frame was at the time of its stamp; it waits until
    that is known. A message that is overtaken by a newer one of its frame is given up: what tf
    did not know of its time when it came, such as the first seconds, it never will. `draw` is
    called once for each, and again for those that are shown when a property changes.
    """

    PATIENCE: ClassVar[int] = 10
    """How many messages wait for their transform."""
    GRACE_S: ClassVar[float] = 2.0
    """How long nothing may be drawn for want of a transform before that is said; transforms come
    a moment later than what was measured at the same time, more so on a busy computer."""
    MOST: ClassVar[int] = 50
    """How many messages are shown at once while they decay."""

    def start(self) -> None:
        """Subscribe the topic."""
        self._waiting: deque[Waiting] = deque()
        self._kept: deque[Kept] = deque()
        self._free: list[Place] = []
        self._missing_since_s: float | None = None
        self._fixed_frame = self.context.frames.fixed_frame
        super().start()

    def stop(self) -> None:
        """Subscribe no longer, and remove what was drawn."""
        super().stop()
        self._waiting.clear()
        self._kept.clear()
        self._free.clear()

    def update(self) -> None:
        """Draw the messages whose place has become known, and remove old ones."""
        super().update()
        if self.context.frames.fixed_frame != self._fixed_frame:
            self._fixed_frame = self.context.frames.fixed_frame
            self.redraw()
        if self._waiting:
            self._draw_ready()
        self._remove_old()

    def draw(self, canvas: Canvas, message: Any, pose: Pose) -> None:
        """
        Draw one message.

        It is called once for each message that is shown, and again after a change of a property.

        Parameters
        ----------
        canvas
            Where to draw; its origin is that of the message's frame.
        message
            The message.
        pose
            The pose of its frame in the fixed frame at its stamp.

        Raises
        ------
        ValueError
            The message cannot be drawn; the reason goes into the status.

        """
        raise NotImplementedError

    def keep(self) -> int:
        """Return how many messages are shown at once."""
        return 1

    def decay_s(self) -> float:
        """Return how long messages are shown; the newest ones that are kept in any case for 0."""
        return 0.0

    def take(self, message: Any) -> None:
        """
        Queue a message until its transform is known.

        Parameters
        ----------
        message
            A message with a header. If too many wait, the oldest is dropped.

        """
        self._waiting.append(Waiting(message, self._now_ns()))
        while len(self._waiting) > max(self.PATIENCE, self.keep()):
            self._waiting.popleft()

    def redraw(self) -> None:
        """Draw the messages that are shown again."""
        for kept in reversed(self._kept):
            self._waiting.appendleft(kept.waiting)
        self._keep_last(0)

    def _draw_ready(self) -> None:
        """Draw those of the waiting messages whose place is known."""
        ready: list[tuple[Waiting, Pose]] = []
        still: list[Waiting] = []
        reason = ''
        for waiting in self._waiting:
            try:
                pose = self._pose_of(waiting.message.header)
            except FrameError as error:
                still.append(waiting)
                reason = str(error)
                continue
            ready.append((waiting, pose))
            frame = waiting.message.header.frame_id
            still = [each for each in still if each.message.header.frame_id != frame]
        last = -self.PATIENCE
        self._waiting = deque(still[last:])
        self._say_missing(reason if still and not ready else '')
        newest = -len(ready) if self.decay_s() else -self.keep()
        for waiting, pose in ready[newest:]:
            self._draw(waiting, pose)

    def _say_missing(self, reason: str) -> None:
        """Say why nothing can be drawn, once that has been so for a while."""
        if not reason:
            self._missing_since_s = None
            self.status.forget('Transform')
            return
        now_s = self.steady_s()
        if self._missing_since_s is None:
            self._missing_since_s = now_s
        if now_s - self._missing_since_s >= self.GRACE_S:
            self.status.say('Transform', Level.ERROR, reason)

    def _draw(self, waiting: Waiting, pose: Pose) -> None:
        place = self._free.pop() if self._free else self._new_place()
        place.node.position, place.node.wxyz = pose
        place.node.visible = True
        try:
            with place.canvas.anew():
                self.draw(place.canvas, waiting.message, pose)
        except ValueError as error:
            self._leave(place)
            self.say_left_out(error)
            return
        self._kept.append(Kept(waiting, place))
        self.say_shown()

    def _new_place(self) -> Place:
        root = f'{self.root}/{len(self._kept) + 1}'
        node = self.context.scene.add_frame(root, show_axes=False)
        return Place(node, Canvas(self.context.scene, root))

    def _leave(self, place: Place) -> None:
        """Hide a place, to draw another message there."""
        place.node.visible = False
        self._free.append(place)

    def _remove_old(self) -> None:
        decay_ns = round(self.decay_s() * 1e9)
        if decay_ns:
            now_ns = self._now_ns()
            while self._kept and now_ns - self._kept[0].waiting.came_ns > decay_ns:
                self._leave(self._kept.popleft().place)
        self._keep_last(self.MOST if decay_ns else self.keep())
        if decay_ns and len(self._kept) == self.MOST:
            self.status.say(
                'Decay', Level.WARN, f'No more than the last {self.MOST} messages are shown.'
            )
        else:
            self.status.forget('Decay')

    def _keep_last(self, count: int) -> None:
        while len(self._kept) > count:
            self._leave(self._kept.popleft().place)

    def _pose_of(self, header: Any) -> Pose:
        stamp_ns = header.stamp.sec * 1_000_000_000 + header.stamp.nanosec
        return self.context.frames.pose(header.frame_id, max(stamp_ns, 0))

    def steady_s(self) -> float:
        """Return the time by which people wait, in seconds."""
        return time.monotonic()

    def _now_ns(self) -> int:
        return int(self.context.node.get_clock().now().nanoseconds)
