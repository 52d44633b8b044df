# SPDX-License-Identifier: Apache-2.0
"""The displays of markers, single or in arrays: all markers, and the queue of those to draw."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from rviz_common.frames import FrameError, Frames, Pose
from rviz_common.properties import Flag, Flags, topic_properties
from rviz_common.selection import Hit, Ray
from rviz_common.status import Level, Statuses
from rviz_common.topic_display import TopicDisplay
from rviz_default_plugins.markers.inbox import Inbox, Key
from rviz_default_plugins.markers.marker_object import pick_marker
from rviz_default_plugins.markers.shown_marker import Coming, ShownMarker
from visualization_msgs.msg import Marker as MarkerMessage
from visualization_msgs.msg import MarkerArray as MarkerArrayMessage

__all__ = ['NAMESPACES', 'Marker', 'MarkerArray', 'MarkerScene', 'Markers']

NAMESPACES = Flags('Namespaces', {}, 'Which markers are shown, by their namespace.')
WHOLE = Flag('Select Namespace', False, 'Whether a click selects all markers of a namespace.')


class Markers(TopicDisplay):
    """A display that draws the messages of a topic as markers."""

    def start(self) -> None:
        """Subscribe to the topic."""
        context = self.context
        self._markers = MarkerScene(context.scene, context.frames, self.root, self.status)
        super().start()

    def update(self) -> None:
        """Draw the queued markers."""
        super().update()
        enabled = self.values['Namespaces']
        self._markers.update(self._now_ns(), lambda namespace: enabled.get(namespace, True))
        new = self._markers.namespaces() - set(enabled)
        if new:
            self.values['Namespaces'] = {**enabled, **dict.fromkeys(sorted(new), True)}
        if self.received:
            sentence = f'{self.received} messages received on {self.values["Topic/Value"]}.'
            self.status.say('Topic', Level.OK, sentence)

    def take(self, message: Any) -> None:
        """
        Queue the markers of a message for the next frames.

        Parameters
        ----------
        message
            As for `TopicDisplay.take`.

        """
        self._markers.put(self.markers_of(message), self._now_ns())

    def markers_of(self, message: Any) -> Iterable[Any]:
        """
        Convert a message to markers.

        Parameters
        ----------
        message
            A message of the topic.

        Returns
        -------
        Iterable[Any]
            Messages of the type `visualization_msgs/msg/Marker`.

        """
        raise NotImplementedError

    def redraw(self) -> None:
        """Do nothing: the next frame shows and hides namespaces."""

    def pick(self, ray: Ray) -> Hit | None:
        """
        Find the first marker on a ray.

        Parameters
        ----------
        ray
            As for `Display.pick`.

        """
        return pick_marker(self._markers.shown, ray, self.name, self.values[WHOLE.path])

    def _now_ns(self) -> int:
        return int(self.context.node.get_clock().now().nanoseconds)


class Marker(Markers):
    """The markers of a topic."""

    CLASS = 'rviz_default_plugins/Marker'
    MESSAGE = MarkerMessage
    PROPERTIES = (
        *topic_properties('visualization_msgs/msg/Marker', '/visualization_marker', depth=10),
        NAMESPACES,
        WHOLE,
    )

    def markers_of(self, message: Any) -> Iterable[Any]:
        """
        Wrap the marker, as the only one of its message.

        Parameters
        ----------
        message
            As for `Markers.markers_of`.

        """
        return (message,)


class MarkerArray(Markers):
    """The markers of a topic that has arrays of them."""

    CLASS = 'rviz_default_plugins/MarkerArray'
    MESSAGE = MarkerArrayMessage
    PROPERTIES = (
        *topic_properties('visualization_msgs/msg/MarkerArray', '/visualization_marker_array'),
        NAMESPACES,
        WHOLE,
    )

    def markers_of(self, message: Any) -> Iterable[Any]:
        """
        Select the markers of an array.

        Parameters
        ----------
        message
            As for `Markers.markers_of`.

        """
        markers: Iterable[Any] = message.markers
        return markers


MOST = 5000
"""The maximum number of markers that are shown."""
MOST_PER_FRAME = 200
"""The maximum number drawn in one frame; the others follow in the next frames."""


class MarkerScene:
    """
    All markers of a display, drawn below a path of the scene.

    Parameters
    ----------
    scene
        The scene of the viser server.
    frames
        The transforms.
    root
        The path of the scene.
    status
        Receives the reasons why markers are not shown.

    Attributes
    ----------
    shown
        The markers, by namespace and id.

    """

    def __init__(self, scene: Any, frames: Frames, root: str, status: Statuses) -> None:
        self._scene, self._frames, self._root, self._status = scene, frames, root, status
        self.shown: dict[Key, ShownMarker] = {}
        self._inbox = Inbox()
        self._left_out: set[Key] = set()
        self._serial = 0
        self._fixed_frame = frames.fixed_frame

    def put(self, markers: Iterable[Any], now_ns: int) -> None:
        """
        Queue markers, which are drawn in the next frames.

        Parameters
        ----------
        markers
            Messages of the type `visualization_msgs/msg/Marker`.
        now_ns
            The time in ns of the node's clock, at which their lifetimes start.

        """
        for marker in markers:
            self._inbox.put(marker, now_ns)

    def namespaces(self) -> set[str]:
        """Return the namespaces of the markers."""
        return {namespace for namespace, _ in self.shown}

    def update(self, now_ns: int, is_enabled: Callable[[str], bool]) -> None:
        """
        Draw queued markers, remove expired ones, and follow frames. Call once per frame.

        Parameters
        ----------
        now_ns
            The time in ns of the node's clock.
        is_enabled
            Returns for a namespace whether its markers are shown.

        """
        for marker in self.shown.values():
            marker.finish()
        self._take_inbox()
        self._end(now_ns)
        if self._frames.fixed_frame != self._fixed_frame:
            self._fixed_frame = self._frames.fixed_frame
            for marker in self.shown.values():
                marker.move_anew()
        self._follow()
        for (namespace, _), marker in self.shown.items():
            marker.show(marker.is_placed and is_enabled(namespace))
        self._say()

    def _take_inbox(self) -> None:
        """Apply the queued messages; a marker that is deleted and added again is only updated."""
        inbox = self._inbox
        if inbox.deletes_all:
            inbox.deletes_all = False
            self._left_out.clear()
            for key in self.shown.keys() - inbox.coming.keys():
                self._remove(key)
        for key, coming in inbox.take_some(MOST_PER_FRAME):
            if coming.marker.action == MarkerMessage.DELETE:
                self._remove(key)
            else:
                self._set(key, coming)

    def _set(self, key: Key, coming: Coming) -> None:
        shown = self.shown.get(key)
        if shown is None:
            if len(self.shown) >= MOST:
                self._left_out.add(key)
                return
            self._serial += 1
            shown = ShownMarker(self._scene, f'{self._root}/{self._serial}')
            self.shown[key] = shown
            self._left_out.discard(key)
        shown.change(coming)

    def _remove(self, key: Key) -> None:
        self._left_out.discard(key)
        shown = self.shown.pop(key, None)
        if shown is not None:
            shown.remove()

    def _end(self, now_ns: int) -> None:
        for key in [key for key, shown in self.shown.items() if shown.is_over(now_ns)]:
            self._remove(key)

    def _follow(self) -> None:
        """Move the markers with their frames; each frame is looked up once."""
        poses: dict[tuple[str, int], Pose | FrameError] = {}
        for marker in self.shown.values():
            if not marker.needs_pose:
                continue
            asked = marker.frame_id, marker.stamp_ns
            if asked not in poses:
                poses[asked] = self._pose(*asked)
            pose = poses[asked]
            if isinstance(pose, Pose):
                marker.place(pose)
            elif marker.is_locked:
                marker.move_anew()
        errors = [each for each in poses.values() if isinstance(each, FrameError)]
        if errors:
            self._status.say('Transform', Level.ERROR, str(errors[0]))
        else:
            self._status.forget('Transform')

    def _pose(self, frame_id: str, stamp_ns: int) -> Pose | FrameError:
        try:
            return self._frames.pose(frame_id, stamp_ns)
        except FrameError as error:
            return error

    def _say(self) -> None:
        """Report the markers that are not shown, and the reason for the first of them."""
        self._say_first('Markers', Level.ERROR, 'not shown', lambda shown: shown.problem)
        self._say_first('Notes', Level.WARN, 'not as intended', lambda shown: shown.note)
        if self._inbox.refusal:
            self._status.say('Action', Level.ERROR, self._inbox.refusal)
        if self._left_out:
            sentence = f'{len(self._left_out)} more than {MOST} markers are left out.'
            self._status.say('Number', Level.WARN, sentence)
        else:
            self._status.forget('Number')

    def _say_first(
        self, subject: str, level: Level, what: str, of: Callable[[ShownMarker], str]
    ) -> None:
        said = [(key, of(shown)) for key, shown in self.shown.items() if of(shown)]
        if not said:
            self._status.forget(subject)
            return
        (namespace, number), reason = said[0]
        markers = '1 marker is' if len(said) == 1 else f'{len(said)} markers are'
        sentence = f'{markers} perhaps {what}' if level is Level.WARN else f'{markers} {what}'
        self._status.say(subject, level, f"{sentence}; '{namespace}/{number}': {reason}")
