# SPDX-License-Identifier: Apache-2.0
"""The display of marker arrays."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from rviz_common.properties import topic_properties
from rviz_default_plugins.displays.marker import Markers, NAMESPACES
from visualization_msgs.msg import MarkerArray as MarkerArrayMessage

__all__ = ['MarkerArray']


class MarkerArray(Markers):
    """The markers of a topic that has arrays of them."""

    CLASS = 'rviz_default_plugins/MarkerArray'
    MESSAGE = MarkerArrayMessage
    PROPERTIES = (
        *topic_properties('visualization_msgs/msg/MarkerArray', '/visualization_marker_array'),
        NAMESPACES,
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
