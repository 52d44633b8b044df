# SPDX-License-Identifier: Apache-2.0
"""Displays of markers."""

import io

from builtin_interfaces.msg import Duration
from geometry_msgs.msg import Point
from message_stage import all_sentences, near, sentence
import numpy as np
import pytest
from rviz_default_plugins.displays import marker as marker_module
from rviz_default_plugins.displays.marker import Marker, MarkerArray
from rviz_default_plugins.markers.look import look_of, MOST
from std_msgs.msg import ColorRGBA
import trimesh
from visualization_msgs.msg import Marker as Message
from visualization_msgs.msg import MarkerArray as ArrayMessage

NAN = float('nan')
HALF = 0.5**0.5


def marker(kind=Message.CUBE, number=0, points=(), colors=(), **fields):
    """Return a marker of a size and colour that can be seen."""
    message = Message(type=kind, id=number, ns='test', **fields)
    message.pose.orientation.w = 1.0
    message.scale.x, message.scale.y, message.scale.z = 1.0, 2.0, 3.0
    message.color = ColorRGBA(r=1.0, g=0.5, b=0.0, a=0.5)
    message.points = [Point(x=float(x), y=float(y), z=float(z)) for x, y, z in points]
    message.colors = [ColorRGBA(r=r, g=g, b=b, a=a) for r, g, b, a in colors]
    return message


@pytest.mark.parametrize(
    ('kind', 'properties'),
    [
        (Message.CUBE, {'dimensions': (1, 1, 1), 'scale': (1, 2, 3)}),
        (Message.SPHERE, {'radius': 0.5, 'scale': (1, 2, 3)}),
        (Message.CYLINDER, {'radius': 0.5, 'height': 1.0, 'scale': (1, 2, 3)}),
        (Message.ARROW, {'scale': (1, 2, 3)}),
    ],
)
def test_bodies(message_stage, kind, properties):
    """Bodies have the size, colour and transparency of the marker, and are where it is."""
    display = message_stage.listen(Marker)
    message = marker(kind)
    message.pose.position.x = 4.0
    message_stage.tell(display, message)
    drawn = message_stage.at(display, '1/marker')
    for name, value in properties.items():
        assert getattr(drawn, name) == value
    assert drawn.color == (255, 128, 0)
    assert drawn.opacity == 0.5
    assert near(message_stage.at(display, '1').position, 4, 0, 0)
    assert message_stage.at(display, '1').visible


def test_arrow_between_two_points(message_stage):
    """The arrow goes from the first point to the second, with the diameters of the scale."""
    message = marker(Message.ARROW, points=[(1, 0, 0), (1, 2, 0)])
    message.scale.x, message.scale.y, message.scale.z = 0.1, 0.2, 0.5
    display = message_stage.listen(Marker)
    message_stage.tell(display, message)
    arrow = message_stage.at(display, '1/marker')
    assert near(arrow.position, 1, 0, 0)
    assert near(arrow.wxyz, HALF, 0, 0, HALF)
    assert arrow.vertices[:, 0].max() == pytest.approx(2.0)
    assert arrow.vertices[:, 1].max() == pytest.approx(0.1)


def test_arrow_strip(message_stage):
    """There is an arrow from each point to the next."""
    message = marker(Message.ARROW_STRIP, points=[(0, 0, 0), (1, 0, 0), (1, 1, 0)])
    display = message_stage.listen(Marker)
    message_stage.tell(display, message)
    assert near(message_stage.at(display, '1/marker_1').position, 1, 0, 0)


def test_lines(message_stage):
    """A strip joins all points, a list each two of them; both have the width and colours."""
    points = [(0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0)]
    colors = [(1.0, 0.0, 0.0, 1.0), (0.0, 1.0, 0.0, 1.0)] * 2
    display = message_stage.listen(Marker)
    message_stage.tell(
        display,
        marker(Message.LINE_STRIP, 0, points),
        marker(Message.LINE_LIST, 1, points, colors),
    )
    strip, pairs = (message_stage.at(display, f'{n}/marker') for n in (1, 2))
    assert strip.points[:, :, 0].tolist() == [[0, 1], [1, 2], [2, 3]]
    assert strip.colors.tolist() == [255, 128, 0]
    assert (strip.thickness, strip.thickness_units) == (1.0, 'world')
    assert pairs.points[:, :, 0].tolist() == [[0, 1], [2, 3]]
    assert pairs.colors.tolist() == [[[255, 0, 0], [0, 255, 0]]] * 2


@pytest.mark.parametrize('kind', [Message.CUBE_LIST, Message.SPHERE_LIST])
def test_lists_of_bodies(message_stage, kind):
    """There is a body at each point, with its colour and transparency."""
    points = [(0, 0, 0), (5, 0, 0)]
    colors = [(1.0, 0.0, 0.0, 1.0), (0.0, 0.0, 1.0, 0.25)]
    display = message_stage.listen(Marker)
    message_stage.tell(display, marker(kind, 0, points), marker(kind, 1, points, colors))
    plain, colored = (message_stage.at(display, f'{n}/marker') for n in (1, 2))
    assert near(plain.batched_positions, [0, 0, 0], [5, 0, 0])
    assert plain.batched_colors.tolist() == [255, 128, 0]
    assert plain.opacity == 0.5
    assert near(np.ptp(plain.vertices, axis=0), 1, 2, 3)
    assert colored.batched_colors.tolist() == [[255, 0, 0], [0, 0, 255]]
    assert colored.batched_opacities.tolist() == [1.0, 0.25]


def test_points(message_stage):
    """Points are as great as scale.x, in their colours."""
    colors = [(1.0, 0.0, 0.0, 1.0), (0.0, 0.0, 1.0, 1.0)]
    display = message_stage.listen(Marker)
    message_stage.tell(display, marker(Message.POINTS, 0, [(0, 0, 0), (1, 2, 3)], colors))
    points = message_stage.at(display, '1/marker')
    assert points.points.tolist() == [[0, 0, 0], [1, 2, 3]]
    assert points.colors.tolist() == [[255, 0, 0], [0, 0, 255]]
    assert points.point_size == 1.0


def test_text(message_stage):
    """The text is as high as scale.z."""
    display = message_stage.listen(Marker)
    message_stage.tell(display, marker(Message.TEXT_VIEW_FACING, text='knee'))
    label = message_stage.at(display, '1/marker')
    assert (label.text, label.font_scene_height) == ('knee', 3.0)


def test_triangles(message_stage):
    """Triangles of one colour are a surface; those of several have them in the file."""
    points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
    display = message_stage.listen(Marker)
    message_stage.tell(
        display,
        marker(Message.TRIANGLE_LIST, 0, points),
        marker(Message.TRIANGLE_LIST, 1, points, [(1.0, 0.0, 0.0, 1.0)]),
        marker(Message.TRIANGLE_LIST, 2, points, [(1.0, 0.0, 0.0, 1.0)] * 3),
    )
    plain = message_stage.at(display, '1/marker')
    assert plain.faces.tolist() == [[0, 1, 2]]
    assert plain.color == (255, 128, 0)
    assert plain.scale == (1, 2, 3)
    for number in (2, 3):
        glb = message_stage.at(display, f'{number}/marker').glb_data
        mesh = trimesh.load_scene(io.BytesIO(glb), file_type='glb').to_mesh()
        assert np.sort(mesh.vertices, axis=0).tolist() == np.sort(points, axis=0).tolist()
        assert glb.endswith(np.array([65535, 0, 0, 65535], np.uint16).tobytes() * 3)


def test_mesh(message_stage, tmp_path):
    """A mesh has the colour of the marker."""
    file = tmp_path / 'part.obj'
    file.write_text('v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n')
    display = message_stage.listen(Marker)
    message_stage.tell(display, marker(Message.MESH_RESOURCE, mesh_resource=f'file://{file}'))
    show_mesh(message_stage, display)
    assert sentence(display, 'Markers') == ''
    mesh = message_stage.at(display, '1/marker_0')
    assert len(mesh.faces) == 1
    assert mesh.color == (255, 128, 0)
    assert mesh.scale == (1, 2, 3)


def show_mesh(stage, display):
    """Draw frames until a mesh has been read."""

    def is_read():
        display.update()
        return 'is being read' not in sentence(display, 'Markers')

    stage.work_until(is_read)


def test_broken_mesh(message_stage, tmp_path):
    """A file that is no mesh has a sentence."""
    file = tmp_path / 'broken.stl'
    file.write_bytes(b'solid nothing')
    display = message_stage.listen(Marker)
    message_stage.tell(display, marker(Message.MESH_RESOURCE, mesh_resource=f'file://{file}'))
    show_mesh(message_stage, display)
    assert 'broken.stl' in sentence(display, 'Markers')
    assert message_stage.drawn(display) == []


@pytest.mark.parametrize(
    ('resource', 'reason'),
    [
        ('', 'mesh_resource is empty'),
        ('http://example.org/a.stl', 'is not fetched'),
        ('package://nobody_has_this/a.stl', 'is not installed'),
        ('file:///nowhere/a.stl', 'does not exist'),
    ],
)
def test_meshes_that_cannot_be_shown(message_stage, resource, reason):
    """Why a mesh is not shown is said."""
    display = message_stage.listen(Marker)
    message_stage.tell(display, marker(Message.MESH_RESOURCE, mesh_resource=resource))
    assert reason in sentence(display, 'Markers')


def test_modify_and_delete(message_stage):
    """The same number replaces a marker; DELETE removes it, DELETEALL all of them."""
    display = message_stage.listen(Marker)
    message_stage.tell(display, marker(number=0), marker(number=1), marker(number=2))
    message_stage.tell(display, marker(Message.SPHERE, 0))
    assert message_stage.at(display, '1/marker').radius == 0.5
    message_stage.tell(display, marker(number=0, action=Message.DELETE))
    assert message_stage.drawn(display) == ['2', '2/marker', '3', '3/marker']
    message_stage.tell(display, marker(number=9, action=Message.DELETE))
    message_stage.tell(display, marker(action=Message.DELETEALL), marker(number=7))
    assert message_stage.drawn(display) == ['4', '4/marker']


def test_markers_that_are_deleted_and_sent_again_stay(message_stage):
    """A list that replaces the one before is not drawn anew, but moved: nothing flickers."""
    display = message_stage.listen(Marker)
    message_stage.tell(display, marker(number=1), marker(number=2))
    before = message_stage.at(display, '1/marker')
    moved = marker(number=1)
    moved.pose.position.y = 3.0
    message_stage.tell(display, marker(action=Message.DELETEALL), moved)
    assert message_stage.drawn(display) == ['1', '1/marker']
    assert message_stage.at(display, '1/marker') is before
    assert near(message_stage.at(display, '1').position, 0, 3, 0)


def test_marker_that_only_moves_is_not_drawn_anew(message_stage):
    """What looks the same keeps its body, which is moved."""
    display = message_stage.listen(Marker)
    message_stage.tell(display, marker())
    before = message_stage.at(display, '1/marker')
    moved = marker()
    moved.pose.position.y = 3.0
    message_stage.tell(display, moved)
    assert message_stage.at(display, '1/marker') is before
    assert near(message_stage.at(display, '1').position, 0, 3, 0)


def test_lifetime(message_stage):
    """A marker with a lifetime ends, unless it is sent again; a negative one is no end."""
    display = message_stage.listen(Marker)
    message_stage.tell(
        display,
        marker(number=0, lifetime=Duration(sec=2)),
        marker(number=1, lifetime=Duration(sec=-2)),
    )
    message_stage.node.now_s += 1.5
    message_stage.tell(display, marker(number=0, lifetime=Duration(sec=2)))
    message_stage.node.now_s += 1.5
    display.update()
    assert len(message_stage.drawn(display)) == 4
    message_stage.node.now_s += 1.0
    display.update()
    assert message_stage.drawn(display) == ['2', '2/marker']
    assert 'lifetime of -2 s is negative' in sentence(display, 'Notes')


def test_frames_of_markers(message_stage):
    """A marker stays where its frame was; one that is locked to it follows."""
    stage = message_stage
    stage.move('map', 'base', 1.0)
    display = stage.listen(Marker)
    free, locked = marker(number=0), marker(number=1, frame_locked=True)
    locked.pose.position.x = 0.5
    stage.tell(display, free, locked, frame='base')
    stage.move('map', 'base', 2.0)
    display.update()
    assert near(stage.at(display, '1').position, 1, 0, 0)
    assert near(stage.at(display, '2').position, 2.5, 0, 0)


def test_pose_is_turned_with_its_frame(message_stage):
    """The pose of a marker is in its frame, also where that is turned."""
    stage = message_stage
    stage.move('map', 'base', 1.0, wxyz=(HALF, 0, 0, HALF))
    message = marker()
    message.pose.position.x = 2.0
    display = stage.listen(Marker)
    stage.tell(display, message, frame='base')
    assert near(stage.at(display, '1').position, 1, 2, 0)
    assert near(stage.at(display, '1').wxyz, HALF, 0, 0, HALF)


def test_marker_waits_for_its_frame(message_stage):
    """A marker is hidden until its frame is known."""
    stage = message_stage
    display = stage.listen(Marker)
    stage.tell(display, marker(), frame='late')
    assert not stage.at(display, '1').visible
    assert 'late' in sentence(display, 'Transform')
    stage.move('map', 'late', 1.0)
    display.update()
    assert stage.at(display, '1').visible
    assert sentence(display, 'Transform') == ''


def test_namespaces(message_stage):
    """Namespaces are listed as they come, and hidden as the file or a person says."""
    display = message_stage.listen(MarkerArray, {'Namespaces': {'test': False}})
    other = marker(number=1)
    other.ns = 'a/b'
    message_stage.tell(display, ArrayMessage(markers=[]))
    for each in (marker(), other):
        each.header.frame_id = 'map'
    message_stage.tell(display, ArrayMessage(markers=[marker_in_map(), other]))
    assert not message_stage.at(display, '1').visible
    assert message_stage.at(display, '2').visible
    assert display.to_file()['Namespaces'] == {'test': False, 'a/b': True}
    display.values['Namespaces'] = {'test': True, 'a/b': False}
    display.on_change('Namespaces')
    display.update()
    assert message_stage.at(display, '1').visible
    assert not message_stage.at(display, '2').visible
    assert len(message_stage.node.subscriptions) == 1


def marker_in_map():
    """Return a marker in the fixed frame."""
    message = marker()
    message.header.frame_id = 'map'
    return message


def changed(**fields):
    """Return a marker with other fields."""
    message = marker(fields.pop('kind', Message.CUBE), points=fields.pop('points', ()))
    for path, value in fields.items():
        *above, last = path.split('__')
        target = message
        for name in above:
            target = getattr(target, name)
        setattr(target, last, value)
    return message


@pytest.mark.parametrize(
    ('message', 'reason'),
    [
        (changed(type=77), 'its type 77 is not known'),
        (changed(scale__y=0.0), 'its scale.y is 0, but must be greater than 0'),
        (changed(scale__x=-1.0), 'its scale.x is -1'),
        (changed(scale__x=NAN), 'its scale is nan'),
        (changed(color__r=NAN), 'color has numbers that are not finite'),
        (changed(pose__position__x=NAN), 'position is nan'),
        (changed(pose__orientation__w=NAN), 'orientation has numbers that are not finite'),
        (changed(kind=Message.TEXT_VIEW_FACING), 'text is empty'),
        (changed(kind=Message.LINE_STRIP, points=[(0, 0, 0)]), 'fewer than 2 points'),
        (changed(kind=Message.LINE_LIST, points=[(0, 0, 0)]), '1 points, which is not a multiple'),
        (changed(kind=Message.TRIANGLE_LIST), 'has no points'),
        (changed(kind=Message.POINTS, points=[(NAN, 0, 0)]), '1 of its 1 points are not valid'),
        (changed(kind=Message.POINTS, points=[(0, 0, 0)], colors=[ColorRGBA()] * 2), '2 colors'),
        (changed(kind=Message.ARROW, points=[(0, 0, 0)]), 'an arrow with 1 points'),
    ],
)
def test_broken_markers(message_stage, message, reason):
    """A marker that cannot be shown is named, with the reason; a right one removes that."""
    display = message_stage.listen(Marker)
    message_stage.tell(display, marker(), message)
    assert sentence(display, 'Markers').startswith("1 marker is not shown; 'test/0': ")
    assert reason in sentence(display, 'Markers')
    assert message_stage.drawn(display) == []
    message_stage.tell(display, marker())
    assert sentence(display, 'Markers') == ''
    assert len(message_stage.drawn(display)) == 2


def test_markers_that_are_not_as_meant(message_stage):
    """A quaternion of zeros is no rotation, and a transparent colour is named."""
    display = message_stage.listen(Marker)
    message_stage.tell(display, changed(pose__orientation__w=0.0))
    assert 'quaternion of zeros, treated as the identity' in sentence(display, 'Notes')
    assert near(message_stage.at(display, '1').wxyz, 1, 0, 0, 0)
    message_stage.tell(display, changed(color__a=0.0))
    assert 'it is transparent, since its color has a=0' in sentence(display, 'Notes')
    assert message_stage.drawn(display) == ['1']


def test_unknown_action(message_stage):
    """An action that is none has a sentence."""
    display = message_stage.listen(Marker)
    message_stage.tell(display, marker(action=9))
    assert 'its action 9 is not known' in all_sentences(display)


def test_many_markers_are_drawn_bit_by_bit(message_stage, monkeypatch):
    """In one frame some are drawn, and not more than a limit at all."""
    monkeypatch.setattr(marker_module, 'MOST', 5)
    monkeypatch.setattr(marker_module, 'MOST_PER_FRAME', 3)
    display = message_stage.listen(Marker)
    message_stage.tell(display, *(marker(number=number) for number in range(8)))
    assert len(message_stage.drawn(display)) == 6
    display.update()
    display.update()
    assert len(message_stage.drawn(display)) == 10
    assert sentence(display, 'Number') == '3 more than 5 markers are left out.'


@pytest.mark.parametrize(
    ('kind', 'count', 'left'),
    [
        (Message.POINTS, MOST + 1, MOST // 2 + 1),
        (Message.TRIANGLE_LIST, 3 * MOST, MOST),
    ],
)
def test_huge_lists_are_thinned_by_whole_groups(kind, count, left):
    """Of very many points some are left out, whole lines or triangles at a time."""
    message = Message(type=kind)
    message.points = [Point()] * count
    message.colors = [ColorRGBA()] * count
    look = look_of(message)
    assert len(look.points) == pytest.approx(left, abs=2)
    assert len(look.points) == len(look.colors)
    assert look.note == f'{len(look.points)} of its {count} points are shown.'
