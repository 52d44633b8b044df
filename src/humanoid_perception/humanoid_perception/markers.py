# SPDX-License-Identifier: Apache-2.0
"""Markers of detections, for viewers that cannot show `vision_msgs`."""

from __future__ import annotations

from humanoid_perception.detection import COLOURS, CUT
from vision_msgs.msg import Detection3D, Detection3DArray
from visualization_msgs.msg import Marker, MarkerArray

__all__ = ['markers_of']

_GREY = (0.7, 0.7, 0.7)
_LEAST_M = 0.01
_ABOVE_M, _LETTERS_M = 0.06, 0.07


def markers_of(message: Detection3DArray) -> MarkerArray:
    """
    Convert detections to markers: boxes with labels, which replace all earlier ones.

    The label of a box is its id if it has one, otherwise its class and score.

    Parameters
    ----------
    message
        The detections; the markers use their header.

    """
    header = message.header
    markers = [Marker(header=header, action=Marker.DELETEALL)]
    for number, detection in enumerate(message.detections):
        box = Marker(header=header, ns='boxes', id=number, type=Marker.CUBE)
        box.pose, size = detection.bbox.center, detection.bbox.size
        box.scale.x, box.scale.y, box.scale.z = (
            max(edge, _LEAST_M) for edge in (size.x, size.y, size.z)
        )
        box.color.r, box.color.g, box.color.b = _rgb_of(detection)
        box.color.a = 0.5
        text = Marker(header=header, ns='labels', id=number, type=Marker.TEXT_VIEW_FACING)
        at = detection.bbox.center.position
        text.pose.position.x, text.pose.position.y = at.x, at.y
        text.pose.position.z = at.z + size.z / 2.0 + _ABOVE_M
        text.pose.orientation.w, text.scale.z = 1.0, _LETTERS_M
        text.color.r = text.color.g = text.color.b = text.color.a = 1.0
        text.text = _label_of(detection)
        markers += [box, text]
    return MarkerArray(markers=markers)


def _label_of(detection: Detection3D) -> str:
    if detection.id not in ('', CUT) or not detection.results:
        return str(detection.id)
    name = detection.results[-1].hypothesis.class_id
    return f'{name} {detection.results[0].hypothesis.score:.2f}'


def _rgb_of(detection: Detection3D) -> tuple[float, float, float]:
    """Return the RGB colour that the last result names; grey without one."""
    name = detection.results[-1].hypothesis.class_id if detection.results else ''
    return COLOURS.get(name.partition(' ')[0], _GREY)
