# SPDX-License-Identifier: Apache-2.0
"""Displays of detected objects."""

from builtin_interfaces.msg import Time
from geometry_msgs.msg import Point, Pose, Quaternion, Vector3
from message_stage import all_sentences, near
import pytest
from rviz_default_plugins.displays import detections
from rviz_default_plugins.displays.detections import (
    BoundingBox3D,
    BoundingBox3DArray,
    Detection3D,
    Detection3DArray,
)
from std_msgs.msg import Header
import vision_msgs.msg as vision


def box(x=1.0):
    """Return a box that can be told from others."""
    center = Pose(position=Point(x=x, y=2.0, z=3.0), orientation=Quaternion(w=1.0))
    return vision.BoundingBox3D(center=center, size=Vector3(x=0.1, y=0.2, z=0.3))


def detection(*names, score=0.875, x=1.0, **fields):
    """Return a detection with some classes."""
    results = [
        vision.ObjectHypothesisWithPose(
            hypothesis=vision.ObjectHypothesis(class_id=name, score=score)
        )
        for name in names
    ]
    return vision.Detection3D(results=results, bbox=box(x), **fields)


def several(*found):
    """Return detections as a message."""
    header = Header(frame_id='map', stamp=Time(sec=100))
    return vision.Detection3DArray(header=header, detections=list(found))


def test_a_detection_is_a_box_with_its_name(message_stage):
    """It has the place and size, and the colour that its class names."""
    display = message_stage.listen(Detection3DArray)
    message_stage.tell(display, several(detection('mug', 'red mug')))
    drawn = message_stage.at(display, '1/marker')
    assert drawn.scale == (0.1, 0.2, 0.3)
    assert drawn.color == (217, 31, 26)
    assert drawn.opacity == 0.5
    assert near(message_stage.at(display, '1').position, 1, 2, 3)
    assert near(message_stage.at(display, '2').position, 1, 2, 3.2)
    assert message_stage.at(display, '2/marker').text == 'red mug'


@pytest.mark.parametrize(
    ('given', 'text'),
    [
        ({}, 'mug_7'),
        ({'Show Score': True}, 'mug_7 0.88'),
        ({'Show Label': False, 'Show Score': True}, '0.88'),
    ],
)
def test_labels_say_what_is_asked_for(message_stage, given, text):
    """The id comes before the class; the score is that of the class."""
    display = message_stage.listen(Detection3DArray, given)
    message_stage.tell(display, several(detection('mug', id='mug_7')))
    assert message_stage.at(display, '2/marker').text == text


def test_what_is_gone_is_not_drawn_any_more(message_stage):
    """A message replaces the one before."""
    display = message_stage.listen(Detection3DArray, {'Show Label': False})
    message_stage.tell(display, several(detection('mug'), detection('can', x=2.0)))
    assert message_stage.at(display, '2').visible
    message_stage.tell(display, several(detection('can', x=5.0)))
    assert near(message_stage.at(display, '1').position, 5, 2, 3)
    assert '2' not in message_stage.drawn(display)


def test_classes_have_colours_of_their_own(message_stage):
    """The same class has the same one; all have that of the property if it is asked for."""
    display = message_stage.listen(Detection3DArray, {'Show Label': False})
    found = several(detection('mug'), detection('can'), detection('mug'), detection())
    message_stage.tell(display, found)
    colors = [message_stage.at(display, f'{number}/marker').color for number in (1, 2, 3, 4)]
    assert colors[0] == colors[2] != colors[1]
    assert colors[3] == (255, 196, 0)
    display.values['Color Style'] = 'Flat'
    display.on_change('Color Style')
    display.update()
    assert message_stage.at(display, '1/marker').color == (255, 196, 0)


def test_an_orange_is_not_orange_by_its_name(message_stage):
    """Only a class with a colour before it names one."""
    display = message_stage.listen(Detection3DArray, {'Show Label': False})
    message_stage.tell(display, several(detection('orange', 'green orange')))
    assert message_stage.at(display, '1/marker').color == (38, 153, 51)


def test_edges(message_stage):
    """Of a box there are twelve, and they are as long as it is."""
    display = message_stage.listen(BoundingBox3DArray, {'Only Edge': True})
    header = Header(frame_id='map')
    message_stage.tell(display, vision.BoundingBox3DArray(header=header, boxes=[box()]))
    lines = message_stage.at(display, '1/marker').points
    assert lines.shape == (12, 2, 3)
    lengths = sorted(((lines[:, 0] - lines[:, 1]) ** 2).sum(axis=1) ** 0.5)
    assert lengths == pytest.approx([0.1] * 4 + [0.2] * 4 + [0.3] * 4)


@pytest.mark.parametrize(
    ('kind', 'message'),
    [
        (BoundingBox3D, box()),
        (Detection3D, detection('mug', header=Header(frame_id='map'))),
    ],
)
def test_single_ones(message_stage, kind, message):
    """They are drawn like those of arrays."""
    display = message_stage.listen(kind)
    message_stage.tell(display, message)
    assert near(message_stage.at(display, '1').position, 1, 2, 3)


def test_messages_that_are_not_built(message_stage, monkeypatch):
    """The display says what to do."""

    def missing(name):
        raise ImportError(name)

    monkeypatch.setattr(detections, 'import_module', missing)
    display = message_stage.listen(Detection3DArray)
    display.update()
    assert 'Run `make setup`' in all_sentences(display)
