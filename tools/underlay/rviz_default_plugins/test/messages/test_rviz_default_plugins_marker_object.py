# SPDX-License-Identifier: Apache-2.0
"""Markers that are selected: which one a ray meets, and how it is highlighted."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import Point
from message_stage import MessageStage
import pytest
from rviz_common.selection import Ray, Selection
from rviz_default_plugins.displays.marker import MarkerArray
from rviz_default_plugins.tools.select import Select
from visualization_msgs.msg import Marker as Message
from visualization_msgs.msg import MarkerArray as ArrayMessage

TRIANGLE = [(0.0, -1.0, -1.0), (0.0, 1.0, -1.0), (0.0, 0.0, 1.0)]


def marker(kind: int, number: int = 0, x: float = 0.0, points: Any = (), **fields: Any) -> Any:
    """Return a marker that is 1 x 2 x 3 m large."""
    message = Message(type=kind, id=number, ns='mug', **fields)
    message.header.frame_id = 'map'
    message.pose.position.x = x
    message.pose.orientation.w = 1.0
    message.scale.x, message.scale.y, message.scale.z = 1.0, 2.0, 3.0
    message.color.a = 1.0
    message.points = [Point(x=a, y=b, z=c) for a, b, c in points]
    return message


def shown(stage: MessageStage, *markers: Any, **given: Any) -> Any:
    """Return a display that shows markers."""
    display = stage.listen(MarkerArray, {'Name': 'Things', **given})
    stage.tell(display, ArrayMessage(markers=list(markers)))
    return display


def along_x(y: float = 0.0, z: float = 0.0) -> Ray:
    """Return a ray along x."""
    return Ray((-10.0, y, z), (1.0, 0.0, 0.0))


@pytest.mark.parametrize(
    ('kind', 'points', 'distance'),
    [
        (Message.CUBE, (), 9.5),
        (Message.SPHERE, (), 9.5),
        (Message.CYLINDER, (), 9.5),
        (Message.ARROW, (), 10.0),
        (Message.TRIANGLE_LIST, TRIANGLE, 10.0),
        (Message.CUBE_LIST, [(5.0, 0.0, 0.0), (2.0, 0.0, 0.0)], 11.5),
        (Message.SPHERE_LIST, [(5.0, 0.0, 0.0)], 14.5),
    ],
)
def test_bodies_are_met_where_they_are(
    message_stage: MessageStage, kind: int, points: Any, distance: float
) -> None:
    """The size is the scale of the marker; a ray beside it meets nothing."""
    display = shown(message_stage, marker(kind, points=points))
    hit = display.pick(along_x())
    assert hit.distance == pytest.approx(distance)
    assert (hit.found.name, hit.found.frame) == ('mug/0', 'map')
    assert hit.found.entity == ('mug', '')
    assert display.pick(along_x(y=8.0)) is None


def test_without_a_namespace_it_is_no_object_of_a_simulator(message_stage: MessageStage) -> None:
    """There, the empty name is that of a robot, which must not be pushed instead."""
    message = marker(Message.CUBE)
    message.ns = ''
    assert shown(message_stage, message).pick(along_x()).found.entity is None


def test_lines_are_not_met(message_stage: MessageStage) -> None:
    """A pointer could hardly be on one."""
    points = [(0.0, -1.0, 0.0), (0.0, 1.0, 0.0)]
    display = shown(message_stage, marker(Message.LINE_LIST, points=points))
    assert display.pick(along_x()) is None


def test_hidden_markers_are_not_met(message_stage: MessageStage) -> None:
    """Who hides a namespace can select what is behind it."""
    display = shown(message_stage, marker(Message.CUBE))
    display.values['Namespaces'] = {'mug': False}
    display.update()
    assert display.pick(along_x()) is None


def test_the_nearest_marker_is_selected_and_covered(message_stage: MessageStage) -> None:
    """The cover is larger than the marker, and gone with the selection."""
    display = shown(message_stage, marker(Message.CUBE), marker(Message.SPHERE, 1, x=3.0))
    found = display.pick(along_x()).found
    found.highlight(True)
    assert message_stage.at(display, '1/highlight/marker').scale[0] > 1.0
    assert '2/highlight/marker' not in message_stage.drawn(display)
    assert found.pose().position == (0.0, 0.0, 0.0)
    found.highlight(False)
    assert '1/highlight/marker' not in message_stage.drawn(display)


def test_a_namespace_is_one_object_if_the_file_says_so(message_stage: MessageStage) -> None:
    """All its markers are covered; what changes stays covered, what is deleted is gone."""
    markers = marker(Message.CUBE), marker(Message.SPHERE, 1, x=3.0)
    display = shown(message_stage, *markers, **{'Select Namespace': True})
    selection = Selection(display.pick)
    selection.choose(display.pick(along_x()).found)
    found = selection.chosen
    assert (found.name, found.details()) == ('mug', [('Display', 'Things'), ('Markers', '2')])
    covers = {'1/highlight/marker', '2/highlight/marker'}
    assert covers <= set(message_stage.drawn(display))
    changed = marker(Message.CYLINDER, 1, x=4.0)
    message_stage.tell(display, ArrayMessage(markers=[changed]))
    assert covers <= set(message_stage.drawn(display))
    assert found.is_present
    gone = marker(Message.CUBE, action=Message.DELETE)
    message_stage.tell(display, ArrayMessage(markers=[gone]))
    assert not found.is_present
    selection.update()
    assert selection.chosen is None
    assert not covers & set(message_stage.drawn(display)), 'the rest is covered still'


def test_escape_is_the_key_of_the_tool(message_stage: MessageStage) -> None:
    """It is taken from the start, and given back."""
    tool = Select(message_stage.context, '/world/tools/1')
    commands = message_stage.server.gui._command_handle_from_uuid
    tool.begin()
    assert [each.hotkey for each in commands.values()] == ['escape']
    tool.close()
    assert not commands
