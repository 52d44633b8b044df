# SPDX-License-Identifier: Apache-2.0
"""A display of the last messages of a topic, each placed by the transform at its stamp."""

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
    """A message, and its time of reception in nanoseconds of the node's clock."""

    message: Any
    came_ns: int


class Place(NamedTuple):
    """A node of the scene, and the canvas below it."""

    node: Any
    canvas: Canvas


class Kept(NamedTuple):
    """A message that is drawn, the pose of its frame, and its node of the scene."""

    waiting: Waiting
    pose: Pose
    place: Place


class HistoryDisplay(TopicDisplay):
    """
    A display of the last messages of a topic.

    Each is placed in the fixed frame by the transform of its own frame at its stamp; it waits
    until that transform is available. A waiting message is dropped once a newer one of the same
    frame can be drawn: transforms from before the listener started, say, never become available.
    `draw` is called once for each message, and again for those shown when a property changes;
    they stay where they are, even if their transform is no longer known.
    """

    PATIENCE: ClassVar[int] = 10
    """The maximum number of messages that wait for their transform."""
    GRACE_S: ClassVar[float] = 2.0
    """How long a missing transform may block drawing before it is reported; transforms arrive
    slightly later than measurements of the same time, more so on a busy computer."""
    MOST: ClassVar[int] = 50
    """The maximum number of messages shown at once while they decay."""

    def start(self) -> None:
        """Subscribe to the topic."""
        self._waiting: deque[Waiting] = deque()
        self._kept: deque[Kept] = deque()
        self._free: list[Place] = []
        self._is_outdated = False
        self._missing_since_s: float | None = None
        self._fixed_frame = self.context.frames.fixed_frame
        super().start()

    def stop(self) -> None:
        """Unsubscribe, and remove everything that was drawn."""
        super().stop()
        self._waiting.clear()
        self._kept.clear()
        self._free.clear()

    def update(self) -> None:
        """Draw the messages whose transform has become available, and remove old ones."""
        super().update()
        if self.context.frames.fixed_frame != self._fixed_frame:
            self._fixed_frame = self.context.frames.fixed_frame
            self._place_again()
        elif self._is_outdated:
            self._redraw_kept()
        self._is_outdated = False
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
            The message cannot be drawn; the reason is shown in the status.

        """
        raise NotImplementedError

    def keep(self) -> int:
        """Return the number of messages shown at once."""
        return 1

    def decay_s(self) -> float:
        """Return the decay time of messages in seconds; 0 to show the newest ones instead."""
        return 0.0

    def take(self, message: Any) -> None:
        """
        Queue a message until its transform is available.

        Parameters
        ----------
        message
            A message with a header. If too many wait, the oldest is dropped.

        """
        self._waiting.append(Waiting(message, self._now_ns()))
        while len(self._waiting) > max(self.PATIENCE, self.keep()):
            self._waiting.popleft()

    def redraw(self) -> None:
        """Redraw the messages that are shown, in the next frame."""
        self._is_outdated = True

    def _redraw_kept(self) -> None:
        """Draw the messages that are shown again, where they are."""
        shown, self._kept = self._kept, deque()
        for kept in shown:
            self._draw_at(kept.place, kept.waiting, kept.pose)

    def _place_again(self) -> None:
        """Queue the messages that are shown, to place them in another fixed frame."""
        for kept in reversed(self._kept):
            self._waiting.appendleft(kept.waiting)
        self._keep_last(0)

    def _draw_ready(self) -> None:
        """Draw the waiting messages whose transform is available."""
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
        """Report why nothing can be drawn, after a grace period."""
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
        self._draw_at(place, waiting, pose)

    def _draw_at(self, place: Place, waiting: Waiting, pose: Pose) -> None:
        try:
            with place.canvas.anew():
                self.draw(place.canvas, waiting.message, pose)
        except ValueError as error:
            self._leave(place)
            self.say_left_out(error)
            return
        self._kept.append(Kept(waiting, pose, place))
        self.say_shown()

    def _new_place(self) -> Place:
        root = f'{self.root}/{len(self._kept) + 1}'
        node = self.context.scene.add_frame(root, show_axes=False)
        return Place(node, Canvas(self.context.scene, root))

    def _leave(self, place: Place) -> None:
        """Hide a node of the scene, to reuse it for another message."""
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
            self.status.say('Decay', Level.WARN, f'Only the last {self.MOST} messages are shown.')
        else:
            self.status.forget('Decay')

    def _keep_last(self, count: int) -> None:
        while len(self._kept) > count:
            self._leave(self._kept.popleft().place)

    def _pose_of(self, header: Any) -> Pose:
        stamp_ns = header.stamp.sec * 1_000_000_000 + header.stamp.nanosec
        return self.context.frames.pose(header.frame_id, max(stamp_ns, 0))

    def steady_s(self) -> float:
        """Return the monotonic wall time in seconds."""
        return time.monotonic()

    def _now_ns(self) -> int:
        return int(self.context.node.get_clock().now().nanoseconds)
