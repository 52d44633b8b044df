# SPDX-License-Identifier: Apache-2.0
"""Displays of poses, points, vectors and lines."""

from geometry_msgs.msg import (
    Point32,
    PolygonStamped,
    PoseStamped,
    PoseWithCovarianceStamped,
    WrenchStamped,
)
from geometry_msgs.msg import PointStamped as PointMessage
from geometry_msgs.msg import Pose as PoseMessage
from geometry_msgs.msg import PoseArray as PoseArrayMessage
from geometry_msgs.msg import TwistStamped as TwistMessage
from message_stage import near, sentence, vector
from nav_msgs.msg import Odometry as OdometryMessage
from nav_msgs.msg import Path as PathMessage
import numpy as np
import pytest
from rviz_default_plugins.displays.imu import Imu
from rviz_default_plugins.displays.odometry import Odometry
from rviz_default_plugins.displays.points_and_lines import Path, PointStamped, Polygon
from rviz_default_plugins.displays.pose import Pose, PoseWithCovariance
from rviz_default_plugins.displays.pose_array import MOST, PoseArray
from rviz_default_plugins.displays.range import Range
from rviz_default_plugins.displays.twist_and_wrench import TwistStamped, Wrench
from sensor_msgs.msg import Imu as ImuMessage
from sensor_msgs.msg import Range as RangeMessage

HALF = 0.5**0.5
NAN = float('nan')


def pose_at(x=0.0, y=0.0, z=0.0, w=1.0, turn_z=0.0):
    """Return a pose."""
    pose = PoseMessage()
    vector(pose.position, x, y, z)
    pose.orientation.w, pose.orientation.z = w, turn_z
    return pose


def path_of(*poses):
    """Return a path of poses."""
    return PathMessage(poses=[PoseStamped(pose=pose) for pose in poses])


def test_pose_is_an_arrow_in_its_frame(message_stage):
    """The arrow is at the pose, below what is where the frame is."""
    stage = message_stage
    stage.move('map', 'base', 5.0)
    display = stage.listen(Pose, {'Color': '1; 2; 3', 'Alpha': 0.5, 'Shaft Length': 2})
    stage.tell(display, PoseStamped(pose=pose_at(1.0, w=HALF, turn_z=HALF)), frame='base')
    arrow = stage.at(display, 'arrow')
    assert near(arrow.position, 1, 0, 0)
    assert near(arrow.wxyz, HALF, 0, 0, HALF)
    assert arrow.color == (1, 2, 3)
    assert arrow.opacity == 0.5
    assert arrow.vertices[:, 0].max() == pytest.approx(2.3)
    assert near(stage.node_at(display.root).position, 5, 0, 0)
    assert sentence(display, 'Topic') == '1 messages received on /topic.'


def test_pose_becomes_axes_when_its_shape_is_changed(message_stage):
    """A changed property redraws the newest message; what was drawn before goes."""
    display = message_stage.listen(Pose)
    message_stage.tell(display, PoseStamped(pose=pose_at()))
    display.values['Shape'] = 'Axes'
    display.on_change('Shape')
    display.update()
    assert message_stage.drawn(display) == ['axes']
    assert len(message_stage.node.subscriptions) == 1


def test_changed_topic_is_subscribed(message_stage):
    """Another topic begins anew."""
    display = message_stage.listen(Pose)
    display.values['Topic/Value'] = '/other'
    display.on_change('Topic/Value')
    assert [topic for topic, *_ in message_stage.node.subscriptions] == ['/other']


@pytest.mark.parametrize(
    ('pose', 'reason'),
    [(pose_at(w=0.0), 'quaternion of zeros'), (pose_at(x=NAN), 'position is nan, 0, 0')],
)
def test_broken_pose_leaves_the_one_before(message_stage, pose, reason):
    """A pose that is none has a sentence; the next right one removes it."""
    display = message_stage.listen(Pose)
    message_stage.tell(display, PoseStamped(pose=pose_at(1.0)))
    message_stage.tell(display, PoseStamped(pose=pose))
    assert reason in sentence(display, 'Message')
    assert near(message_stage.at(display, 'arrow').position, 1, 0, 0)
    message_stage.tell(display, PoseStamped(pose=pose_at(2.0)))
    assert sentence(display, 'Message') == ''


def test_frame_that_never_comes(message_stage):
    """What is in a frame that nobody knows is hidden, with a sentence."""
    display = message_stage.listen(Pose)
    message_stage.tell(display, PoseStamped(pose=pose_at()), frame='nowhere')
    assert 'nowhere' in sentence(display, 'Transform')
    assert not message_stage.node_at(display.root).visible


def test_pose_with_covariance(message_stage):
    """The ellipsoid has the standard deviations, times the scale, at the pose."""
    message = PoseWithCovarianceStamped()
    message.pose.pose = pose_at(1.0)
    message.pose.covariance[0], message.pose.covariance[7] = 4.0, 1.0
    display = message_stage.listen(
        PoseWithCovariance, {'Covariance': {'Position': {'Scale': 2, 'Color': '9; 8; 7'}}}
    )
    message_stage.tell(display, message)
    ellipsoid = message_stage.at(display, 'covariance')
    assert sorted(ellipsoid.scale) == pytest.approx([0.001, 2.0, 4.0])
    assert ellipsoid.color == (9, 8, 7)
    assert near(ellipsoid.position, 1, 0, 0)
    display.values['Covariance/Value'] = False
    display.on_change('Covariance/Value')
    display.update()
    assert message_stage.drawn(display) == ['arrow']
    message.pose.covariance[0] = NAN
    display.values['Covariance/Value'] = True
    display.on_change('Covariance/Value')
    display.update()
    assert 'covariance' in sentence(display, 'Message')


@pytest.mark.parametrize(
    ('shape', 'name'), [('Arrow (Flat)', 'lines'), ('Arrow (3D)', 'arrows'), ('Axes', 'axes')]
)
def test_pose_array_is_one_thing(message_stage, shape, name):
    """All poses are drawn together; those that are none are counted."""
    display = message_stage.listen(PoseArray, {'Shape': shape})
    poses = [pose_at(1.0, w=HALF, turn_z=HALF), pose_at(2.0), pose_at(w=0.0), pose_at(x=NAN)]
    message_stage.tell(display, PoseArrayMessage(poses=poses))
    assert message_stage.drawn(display) == [name]
    drawn = message_stage.at(display, name)
    if shape == 'Arrow (Flat)':
        assert drawn.points.shape == (6, 2, 3)
        assert near(drawn.points[0], [1, 0, 0], [1, 0.3, 0])
    else:
        assert near(drawn.batched_positions, [1, 0, 0], [2, 0, 0])
        assert near(drawn.batched_wxyzs[0], HALF, 0, 0, HALF)
    assert sentence(display, 'Poses').startswith('2 of 4 poses are left out')
    message_stage.tell(display, PoseArrayMessage())
    assert message_stage.drawn(display) == []


def test_huge_pose_array_is_thinned(message_stage):
    """Of very many poses each n-th is shown, with both numbers."""
    display = message_stage.listen(PoseArray)
    message_stage.tell(display, PoseArrayMessage(poses=[pose_at()] * (2 * MOST)))
    assert sentence(display, 'Number') == f'{MOST} of {2 * MOST} poses are shown.'


def test_polygon_is_closed(message_stage):
    """The line goes back to the first point; a point that is nowhere refuses the message."""
    message = PolygonStamped()
    message.polygon.points = [Point32(x=float(x)) for x in range(3)]
    display = message_stage.listen(Polygon, {'Color': '1; 2; 3'})
    message_stage.tell(display, message)
    line = message_stage.at(display, 'line')
    assert line.points[:, :, 0].tolist() == [[0, 1], [1, 2], [2, 0]]
    assert line.colors.tolist() == [1, 2, 3]
    broken = PolygonStamped()
    broken.polygon.points = [Point32(x=NAN)]
    message_stage.tell(display, broken)
    assert '1 of its 1 points' in sentence(display, 'Message')
    message_stage.tell(display, PolygonStamped())
    assert message_stage.drawn(display) == []


def test_path_is_a_line(message_stage):
    """The line goes through the poses, moved by the offset; Billboards have a width."""
    given = {
        'Offset': {'X': 0, 'Y': 0, 'Z': 1},
        'Line Style': 'Billboards',
        'Line Width': 0.2,
        'Color': '1; 2; 3',
    }
    display = message_stage.listen(Path, given)
    message_stage.tell(display, path_of(pose_at(0.0), pose_at(1.0), pose_at(3.0)))
    line = message_stage.at(display, '1/line')
    assert line.points.tolist() == [[[0, 0, 1], [1, 0, 1]], [[1, 0, 1], [3, 0, 1]]]
    assert (line.thickness, line.thickness_units) == (0.2, 'world')
    display.values['Line Style'] = 'Lines'
    display.on_change('Line Style')
    display.update()
    assert message_stage.at(display, '1/line').thickness_units == 'screen'
    assert message_stage.drawn(display) == ['1', '1/line']


@pytest.mark.parametrize('style', ['Axes', 'Arrows'])
def test_poses_of_a_path(message_stage, style):
    """Axes or arrows show the poses; a quaternion of zeros refuses them."""
    display = message_stage.listen(Path, {'Pose Style': style})
    message_stage.tell(display, path_of(pose_at(1.0), pose_at(2.0)))
    assert near(message_stage.at(display, '1/poses').batched_positions, [1, 0, 0], [2, 0, 0])
    message_stage.tell(display, path_of(pose_at(w=0.0)))
    assert '1 of its 1 poses have quaternions of zeros' in sentence(display, 'Message')


def test_strange_paths(message_stage):
    """A path may be empty or one pose long; points must be somewhere; a huge one is thinned."""
    display = message_stage.listen(Path)
    message_stage.tell(display, path_of())
    message_stage.tell(display, path_of(pose_at()))
    assert sentence(display, 'Message') == ''
    message_stage.tell(display, path_of(pose_at(), pose_at(y=NAN)))
    assert '1 of its 2 points' in sentence(display, 'Message')
    message_stage.tell(display, PathMessage(poses=[PoseStamped()] * 50000))
    assert sentence(display, 'Path') == '16667 of the 50000 poses of the path are shown.'


def test_last_paths_stay_where_they_were(message_stage):
    """Buffer Length paths are shown, each where its frame was at its time."""
    stage = message_stage
    display = stage.listen(Path, {'Buffer Length': 2})
    for x in (1.0, 2.0, 3.0):
        stage.move('map', 'base', x)
    for second in (1, 2, 3):
        message = path_of(pose_at(), pose_at(1.0))
        message.header.stamp.sec = second
        stage.tell(display, message, frame='base')
    assert stage.drawn(display) == ['2', '2/line', '3', '3/line']
    assert near(stage.at(display, '2').position, 2, 0, 0)
    assert near(stage.at(display, '3').position, 3, 0, 0)


def test_changed_property_keeps_old_messages(message_stage):
    """They are redrawn where they are, though their transforms are no longer known."""
    stage = message_stage
    display = stage.listen(PointStamped, {'Radius': 0.5, 'History Length': 20})
    for x in range(20):
        stage.move('map', 'base', float(x))
        message = PointMessage()
        message.header.stamp.sec = x + 1
        stage.tell(display, message, frame='base')
    stage.buffer.clear()
    stage.move('map', 'base', 20.0)
    display.values['Radius'] = 0.25
    display.on_change('Radius')
    message = PointMessage()
    message.header.stamp.sec = 21
    stage.tell(display, message, frame='base')
    drawn = [path for path in stage.drawn(display) if path.endswith('/point')]
    assert len(drawn) == 20
    assert {stage.at(display, path).radius for path in drawn} == {0.25}
    assert near(stage.at(display, '2').position, 1, 0, 0)
    assert near(stage.at(display, '21').position, 20, 0, 0)


def test_message_waits_for_its_transform(message_stage):
    """What comes before its transform is drawn when that comes; other fixed frames move it."""
    stage = message_stage
    display = stage.listen(PointStamped)
    message = PointMessage()
    message.header.stamp.sec = 2
    stage.move('map', 'base', 1.0)
    stage.tell(display, message, frame='base')
    assert stage.drawn(display) == []
    display.GRACE_S = 0.0
    display.update()
    assert sentence(display, 'Transform') != ''
    stage.move('map', 'base', 7.0)
    display.update()
    assert near(stage.at(display, '1').position, 7, 0, 0)
    assert sentence(display, 'Transform') == ''
    stage.frames.fixed_frame = 'base'
    display.update()
    assert near(stage.at(display, '1').position, 0, 0, 0)


def test_messages_without_transform_do_not_pile_up(message_stage):
    """Only the last ones wait."""
    display = message_stage.listen(PointStamped)
    for _ in range(100):
        message_stage.tell(display, PointMessage(), frame='nowhere')
    assert len(display._waiting) == display.PATIENCE


def test_negative_stamp_means_the_latest(message_stage):
    """A stamp before time began does no harm."""
    message = PointMessage()
    message.header.stamp.sec = -5
    display = message_stage.listen(PointStamped)
    message_stage.tell(display, message)
    assert message_stage.drawn(display) == ['1', '1/point']


def test_odometry_shows_where_the_robot_has_been(message_stage):
    """A pose is shown when the robot has moved or turned enough, and so many are kept."""
    display = message_stage.listen(
        Odometry, {'Keep': 2, 'Covariance': {'Value': False}, 'Shape': {'Head Length': 0.5}}
    )
    for pose in (
        pose_at(),
        pose_at(0.05),
        pose_at(0.2),
        pose_at(0.2, w=0.999, turn_z=0.01),
        pose_at(0.2, w=HALF, turn_z=HALF),
    ):
        message = OdometryMessage()
        message.pose.pose = pose
        message_stage.tell(display, message)
    assert message_stage.drawn(display) == ['2', '2/arrow', '3', '3/arrow']
    assert near(message_stage.at(display, '2/arrow').position, 0.2, 0, 0)
    assert near(message_stage.at(display, '3/arrow').wxyz, HALF, 0, 0, HALF)
    assert message_stage.at(display, '3/arrow').vertices[:, 0].max() == pytest.approx(1.5)


def test_broken_odometry_is_left_out(message_stage):
    """A quaternion of zeros has a sentence and does not count as a place."""
    display = message_stage.listen(Odometry)
    message = OdometryMessage()
    message.pose.pose = pose_at(w=0.0)
    message_stage.tell(display, message)
    assert 'quaternion of zeros' in sentence(display, 'Message')
    assert message_stage.drawn(display) == []


def test_point_is_a_sphere(message_stage):
    """The sphere is at the point; the last ones are kept."""
    display = message_stage.listen(PointStamped, {'Radius': 0.5, 'History Length': 2})
    for x in (1.0, 2.0, 3.0, NAN):
        message = PointMessage()
        vector(message.point, x)
        message_stage.tell(display, message)
    assert near(message_stage.at(display, '3/point').position, 3, 0, 0)
    assert message_stage.at(display, '3/point').radius == 0.5
    assert message_stage.drawn(display) == ['2', '2/point', '3', '3/point']
    assert 'its point is nan, 0, 0' in sentence(display, 'Message')


def test_range_is_a_cone(message_stage):
    """The cone is as long as the range and as wide as the field of view."""
    display = message_stage.listen(Range, {'Alpha': 0.25})
    message = RangeMessage(field_of_view=np.pi / 2, min_range=0.1, max_range=4.0, range=2.0)
    message_stage.tell(display, message)
    cone = message_stage.at(display, '1/cone')
    assert cone.vertices[:, 0].max() == pytest.approx(2.0)
    assert cone.vertices[:, 1].max() == pytest.approx(2.0)
    assert cone.opacity == 0.25


@pytest.mark.parametrize(
    ('message', 'drawn', 'reason'),
    [
        (RangeMessage(range=NAN, max_range=1.0), False, 'range is not a number'),
        (RangeMessage(field_of_view=4.0, range=1.0), False, 'field of view is 4 rad'),
        (RangeMessage(field_of_view=0.1, range=9.0, max_range=5.0), False, ''),
        (RangeMessage(range=float('inf'), max_range=float('inf')), False, 'cone is inf m long'),
        (
            RangeMessage(field_of_view=0.1, min_range=3.0, max_range=3.0, range=-float('inf')),
            True,
            '',
        ),
        (
            RangeMessage(field_of_view=0.1, min_range=3.0, max_range=3.0, range=float('inf')),
            False,
            '',
        ),
    ],
)
def test_strange_ranges(message_stage, message, drawn, reason):
    """What hit nothing is not drawn; what is no range has a sentence."""
    display = message_stage.listen(Range)
    message_stage.tell(display, message)
    assert ('1/cone' in message_stage.drawn(display)) == drawn
    assert reason in sentence(display, 'Message')


def test_wrench_is_two_arrows(message_stage):
    """The arrows have the directions and lengths of force and torque, times their scales."""
    message = WrenchStamped()
    vector(message.wrench.force, z=10.0)
    vector(message.wrench.torque, x=4.0)
    display = message_stage.listen(Wrench, {'Force Arrow Scale': 0.1, 'Torque Arrow Scale': 0.5})
    message_stage.tell(display, message)
    force = message_stage.at(display, '1/force')
    assert force.vertices[:, 0].max() == pytest.approx(1.0)
    assert near(force.wxyz, HALF, 0, -HALF, 0)
    assert message_stage.at(display, '1/torque').vertices[:, 0].max() == pytest.approx(2.0)
    assert '1/circle' in message_stage.drawn(display)


def test_strange_wrenches(message_stage):
    """Nothing is drawn for zero; NaN has a sentence."""
    display = message_stage.listen(Wrench)
    message_stage.tell(display, WrenchStamped())
    assert message_stage.drawn(display) == ['1']
    message = WrenchStamped()
    message.wrench.torque.y = NAN
    message_stage.tell(display, message)
    assert 'its torque vector is 0, nan, 0' in sentence(display, 'Message')


def test_twist_is_two_arrows(message_stage):
    """Small velocities are hidden if the file says so."""
    message = TwistMessage()
    vector(message.twist.linear, y=-2.0)
    vector(message.twist.angular, z=1e-6)
    display = message_stage.listen(TwistStamped)
    message_stage.tell(display, message)
    assert message_stage.drawn(display) == ['1', '1/linear']
    assert near(message_stage.at(display, '1/linear').wxyz, HALF, 0, 0, -HALF)
    vector(message.twist.linear, x=NAN)
    message_stage.tell(display, TwistMessage(twist=message.twist))
    assert 'its linear vector is nan, 0, 0' in sentence(display, 'Message')


def test_imu_shows_orientation_and_acceleration(message_stage):
    """Box and axes have the orientation in the fixed frame; the arrow is turned likewise."""
    stage = message_stage
    stage.move('map', 'imu', 2.0, wxyz=(0, 1, 0, 0))
    message = ImuMessage()
    message.orientation.w, message.orientation.z = HALF, HALF
    vector(message.linear_acceleration, x=2.0)
    given = {
        'Box properties': {'Enable box': True, 'x_scale': 0.5},
        'Acceleration properties': {'Enable acceleration': True, 'Acc. vector scale': 0.5},
    }
    display = stage.listen(Imu, given)
    stage.tell(display, message, frame='imu')
    assert near(stage.at(display, 'box').wxyz, HALF, 0, 0, HALF)
    assert near(stage.at(display, 'box').dimensions, 0.5, 1, 1)
    assert near(stage.at(display, 'axes').wxyz, HALF, 0, 0, HALF)
    arrow = stage.at(display, 'acceleration')
    assert arrow.vertices[:, 0].max() == pytest.approx(1.0)
    assert near(arrow.wxyz, HALF, 0, 0, HALF)
    assert near(stage.node_at(display.root).position, 2, 0, 0)
    assert near(stage.node_at(display.root).wxyz, 1, 0, 0, 0)
    display.values['fixed_frame_orientation'] = False
    display.on_change('fixed_frame_orientation')
    display.update()
    assert near(stage.node_at(display.root).wxyz, 0, 1, 0, 0)


def test_strange_imus(message_stage):
    """A quaternion of zeros is refused, unless the IMU says that it measures none."""
    display = message_stage.listen(Imu)
    message = ImuMessage()
    message.orientation.w = 0.0
    message_stage.tell(display, message)
    assert 'quaternion of zeros' in sentence(display, 'Message')
    without = ImuMessage()
    without.orientation.w = 0.0
    without.orientation_covariance[0] = -1.0
    message_stage.tell(display, without)
    assert sentence(display, 'Orientation') == 'The IMU does not measure its orientation.'
    assert near(message_stage.at(display, 'axes').wxyz, 1, 0, 0, 0)
