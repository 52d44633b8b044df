# SPDX-License-Identifier: Apache-2.0
"""Markers as objects that a user can select: one marker, or all of a namespace."""

from __future__ import annotations

from collections.abc import Mapping

from rviz_common.frames import Pose
from rviz_common.selection import Hit, Ray, SceneObject
from rviz_default_plugins.markers.inbox import Key
from rviz_default_plugins.markers.shown_marker import ShownMarker

__all__ = ['MarkerObject', 'pick_marker']

Markers = Mapping[Key, ShownMarker]


class MarkerObject(SceneObject):
    """
    A marker, or the markers of a namespace together.

    Parameters
    ----------
    markers
        All markers of the display.
    key
        The marker that was clicked.
    display
        The name of the display.
    is_whole
        Whether its namespace is the object, of which the marker is a part.

    """

    def __init__(self, markers: Markers, key: Key, display: str, is_whole: bool) -> None:
        self._markers, self._key, self._display = markers, key, display
        self._is_whole = is_whole
        self._marker = markers[key]
        namespace, number = key
        self.name = namespace if is_whole and namespace else f'{namespace}/{number}'
        self.frame = self._marker.frame_id

    @property
    def is_present(self) -> bool:
        """Whether the marker that was clicked is still in the scene."""
        return self._markers.get(self._key) is self._marker

    @property
    def entity(self) -> tuple[str, str] | None:
        """The name of the object: the namespace of its markers; None if they have none."""
        namespace = self._key[0]
        return (namespace, '') if namespace else None

    def pose(self) -> Pose | None:
        """Return the pose of the marker that was clicked; None if it is not shown."""
        return self._marker.pose

    def details(self) -> list[tuple[str, str]]:
        """Return the display, and how many markers there are."""
        lines = [('Display', self._display)]
        if self._is_whole:
            lines.append(('Markers', str(len(self._parts()))))
        return lines

    def highlight(self, is_highlighted: bool) -> None:
        """
        Highlight the markers, or stop doing so.

        Parameters
        ----------
        is_highlighted
            As for `SceneObject.highlight`.

        """
        for marker in self._parts():
            marker.highlight(is_highlighted)

    def _parts(self) -> list[ShownMarker]:
        if not self._is_whole:
            return [self._marker]
        namespace = self._key[0]
        return [marker for (name, _), marker in self._markers.items() if name == namespace]


def pick_marker(markers: Markers, ray: Ray, display: str, is_whole: bool) -> Hit | None:
    """
    Find the first marker on a ray.

    Parameters
    ----------
    markers
        The markers of a display.
    ray
        The ray, in the fixed frame.
    display, is_whole
        As for `MarkerObject`.

    """
    hits = [(marker.hit(ray), key) for key, marker in markers.items()]
    found = [(distance, key) for distance, key in hits if distance is not None]
    if not found:
        return None
    distance, key = min(found)
    return Hit(distance, MarkerObject(markers, key, display, is_whole))
