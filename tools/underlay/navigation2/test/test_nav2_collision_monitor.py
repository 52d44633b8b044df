# SPDX-License-Identifier: Apache-2.0
"""The collision monitor and detector: shapes, actions, sources, zones from topics."""

from __future__ import annotations

import math
import time

from geometry_msgs.msg import (
    Point32,
    PolygonInstanceStamped,
    PolygonStamped,
    TransformStamped,
    Twist,
    TwistStamped,
)
from nav2_collision_monitor import (
    act_in_zone,
    Action,
    ActionType,
    Circle,
    collision_time,
    CollisionDetector,
    CollisionMonitor,
    most_careful,
    parse_points,
    Polygon,
    Zone,
)
from nav2_collision_monitor.observations import (
    points_of_cloud,
    points_of_polygon,
    points_of_range,
    points_of_scan,
)
from nav2_collision_monitor.shapes import VelocityPolygon
from nav2_msgs.msg import CollisionDetectorState, CollisionMonitorState
from nav2_msgs.srv import Toggle
from nav2_util.twist import Velocity
import numpy as np
import pytest
from rclpy.lifecycle import TransitionCallbackReturn
from rclpy.parameter import Parameter
from sensor_msgs.msg import LaserScan, PointCloud2, PointField, Range
from std_msgs.msg import Float32
from tf2_ros import TransformBroadcaster
from visualization_msgs.msg import MarkerArray

SQUARE = '[[0.5, 0.5], [0.5, -0.5], [-0.5, -0.5], [-0.5, 0.5]]'
FORWARD = Velocity(x=0.4, yaw=0.2)


def cluster(x, y=0.0, count=10):
    """Return some points close together."""
    return np.array([(x, y + 0.001 * index) for index in range(count)])


class TestShapes:
    def test_polygon_that_is_not_convex(self):
        """Points in the notch of a U are outside."""
        shape = Polygon(
            parse_points('[[0, 0], [3, 0], [3, 3], [2, 3], [2, 1], [1, 1], [1, 3], [0, 3]]')
        )
        points = np.array([(0.5, 2.0), (1.5, 2.0), (2.5, 2.0), (1.5, 0.5), (9.0, 9.0)])
        assert shape.contains(points).tolist() == [True, False, True, True, False]

    def test_circle(self):
        """Points on the outline are inside."""
        points = np.array([(1.0, 0.0), (0.8, 0.8), (0.0, -0.5)])
        assert Circle(1.0).contains(points).tolist() == [True, False, True]

    @pytest.mark.parametrize(
        'text',
        ['', '[]', '[[1, 2], [3, 4]]', '[1, 2, 3]', '[[1, 2, 3], [1, 2, 3], [1, 2, 3]]',
         '[[1, 2], [3, 4], [5, NaN]]', '[[1, 2], [3, 4], [5, 1e999]]', '[[1,2],[3,4],[5,"6"]',
         '[[true, 1], [2, 3], [4, 5]]', '{"a": 1}', 'null']
    )  # fmt: skip
    def test_malformed_points(self, text):
        """Texts that are no polygon are refused."""
        with pytest.raises(ValueError, match=r'^(are|have|must be) '):
            parse_points(text)


class TestApproach:
    shape = Polygon(parse_points(SQUARE))

    def time_to(self, points, velocity, **options):
        given = {'min_points': 4, 'horizon_s': 2.0, 'step_s': 0.1, **options}
        return collision_time(points, self.shape, velocity, **given)

    def test_straight_on(self):
        """The time is the way to the obstacle by the speed."""
        assert self.time_to(cluster(1.02), Velocity(x=0.5)) == pytest.approx(1.1)
        assert self.time_to(cluster(1.02), Velocity(x=-0.5)) is None
        assert self.time_to(cluster(1.02), Velocity()) is None
        assert self.time_to(cluster(0.3), Velocity()) == 0.0
        assert self.time_to(cluster(1.02, count=3), Velocity(x=0.5)) is None
        assert self.time_to(np.empty((0, 2)), Velocity(x=0.5)) is None

    def test_turning(self):
        """A corner that swings round hits what is beside the robot."""
        beside = cluster(0.0, 0.6)
        assert self.time_to(beside, Velocity(yaw=0.5)) == pytest.approx(0.9, abs=0.31)
        assert collision_time(
            beside, Circle(0.5), Velocity(yaw=0.5), min_points=4, horizon_s=2.0, step_s=0.1
        ) is None  # fmt: skip

    def test_extreme_values(self):
        """Huge speeds, horizons and numbers of points end in reasonable time."""
        assert self.time_to(cluster(0.6), Velocity(1e9, -1e9, 0.0)) is None
        whirl_s = self.time_to(cluster(0.6), Velocity(1e300, -1e300, 1e300))
        assert whirl_s is None or 0.0 <= whirl_s <= 2.0
        assert self.time_to(cluster(1.02), Velocity(x=1e-3), horizon_s=1e6, step_s=1e-3) < 700.0
        assert self.time_to(cluster(0.6), Velocity(x=1.0), horizon_s=0.0) is None
        many = np.random.default_rng(1).uniform(1.0, 2.0, (100_000, 2))
        assert self.time_to(many, Velocity(x=1.0, y=1.0)) is not None


def zone(kind, **options):
    return Zone('Zone', kind, Polygon(parse_points(SQUARE)), **options)


class TestActions:
    def test_each_action(self):
        """Each type does to the velocity what it is for."""
        near = cluster(0.4)
        assert act_in_zone(zone(ActionType.STOP), near, FORWARD).velocity.is_zero
        slow = act_in_zone(zone(ActionType.SLOWDOWN, slowdown_ratio=0.3), near, FORWARD)
        assert slow.velocity == pytest.approx((0.12, 0.0, 0.06))
        limited = act_in_zone(zone(ActionType.LIMIT, linear_limit=0.1), near, FORWARD)
        assert limited.velocity == pytest.approx((0.1, 0.0, 0.05))
        turning = act_in_zone(zone(ActionType.LIMIT, angular_limit=0.1), near, FORWARD)
        assert turning.velocity == pytest.approx((0.2, 0.0, 0.1))
        below = act_in_zone(zone(ActionType.LIMIT), near, FORWARD)
        assert below == Action(ActionType.DO_NOTHING, FORWARD)
        assert act_in_zone(zone(ActionType.DO_NOTHING), near, FORWARD).velocity == FORWARD

    def test_too_few_points_or_none_inside(self):
        """Points outside, and fewer than min_points, have no effect."""
        for points in (cluster(0.6), cluster(0.4, count=3), np.empty((0, 2))):
            action = act_in_zone(zone(ActionType.STOP), points, FORWARD)
            assert action == Action(ActionType.DO_NOTHING, FORWARD)

    def test_approach_in_proportion(self):
        """The velocity falls in proportion to the time until the collision."""
        command = Velocity(x=0.5)
        speeds = [
            act_in_zone(zone(ActionType.APPROACH), cluster(distance), command).velocity.x
            for distance in (1.6, 1.27, 1.02, 0.77, 0.4)
        ]
        assert speeds == pytest.approx([0.5, 0.4, 0.275, 0.15, 0.0])

    def test_the_most_careful_wins(self):
        """A stop goes before all, else the lowest speed counts."""
        slow = Action(ActionType.SLOWDOWN, FORWARD.scaled(0.5), 'a')
        slower = Action(ActionType.LIMIT, FORWARD.scaled(0.2), 'b')
        stop = Action(ActionType.STOP, Velocity(), 'c')
        assert most_careful([slow, slower], FORWARD) is slower
        assert most_careful([slower, slow, stop], FORWARD) is stop
        assert most_careful([], FORWARD) == Action(ActionType.DO_NOTHING, FORWARD)


class TestVelocityPolygons:
    def test_ranges(self):
        """The polygon counts for its velocities along x, or in its directions."""
        limits = {'linear_min': 0.0, 'linear_max': 0.5, 'theta_min': -1.0, 'theta_max': 1.0}
        polygon = VelocityPolygon('a', Polygon(parse_points(SQUARE)), **limits)
        assert polygon.covers(Velocity(0.5, 0.0, -1.0), False)
        assert not polygon.covers(Velocity(-0.1), False)
        assert not polygon.covers(Velocity(0.1, 0.0, 1.1), False)
        back = VelocityPolygon(
            'b', polygon.shape, **limits, direction_start_angle=2.0, direction_end_angle=-2.0
        )
        assert back.covers(Velocity(-0.1), True) and not back.covers(Velocity(0.1), True)
        side = VelocityPolygon(
            'c', polygon.shape, **limits, direction_start_angle=1.0, direction_end_angle=2.0
        )
        assert side.covers(Velocity(0.0, 0.3), True) and not side.covers(Velocity(0.3), True)


def cloud_of(points, point_step=16, order='<'):
    """Return a point cloud message of (N, 3) points."""
    message = PointCloud2(height=1, width=len(points), point_step=point_step)
    message.header.frame_id = 'base_footprint'
    message.is_bigendian = order == '>'
    message.row_step = point_step * len(points)
    message.fields = [
        PointField(name=name, offset=4 * index, datatype=PointField.FLOAT32, count=1)
        for index, name in enumerate('xyz')
    ]
    data = np.zeros((len(points), point_step), np.uint8)
    data[:, :12] = np.asarray(points, order + 'f4').reshape(-1, 3).view(np.uint8)
    message.data = data.tobytes()
    return message


class TestObservations:
    def test_scan(self):
        """Ranges that are none, or beyond the limits, are no points."""
        ranges = [1.0, math.inf, math.nan, 0.01, 99.0, 2.0]
        points = points_of_scan(ranges, 0.0, math.pi / 10, 0.1, 10.0)
        assert points == pytest.approx(np.array([(1.0, 0.0, 0.0), (0.0, 2.0, 0.0)]), abs=1e-9)
        assert points_of_scan([], 0.0, 0.1, 0.1, 10.0).shape == (0, 3)

    def test_range(self):
        """A sonar gives an arc; beyond its range, nothing."""
        points = points_of_range(1.0, 0.4, 0.1, 2.0, 0.1)
        assert len(points) == 5 and np.hypot(*points[:, :2].T) == pytest.approx(1.0)
        for distance in (math.inf, math.nan, 0.05, 3.0):
            assert not len(points_of_range(distance, 0.4, 0.1, 2.0, 0.1))
        assert not len(points_of_range(1.0, math.nan, 0.1, 2.0, 0.1))
        assert len(points_of_range(1.0, 1e9, 0.1, 2.0, 0.0)) < 10_000

    @pytest.mark.parametrize('order', ['<', '>'])
    def test_cloud(self, order):
        """Points that are not finite are left out, whatever the byte order is."""
        points = [(1.0, 2.0, 3.0), (math.nan, 0.0, 0.0), (4.0, 5.0, 6.0)]
        found = points_of_cloud(cloud_of(points, order=order))
        assert found.tolist() == [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]
        assert points_of_cloud(cloud_of([])).shape == (0, 3)

    def test_malformed_clouds(self):
        """Clouds without x, y, z or with too few bytes are refused."""
        short = cloud_of([(1.0, 2.0, 3.0)] * 3)
        short.data = short.data[:20]
        with pytest.raises(ValueError, match='fewer bytes'):
            points_of_cloud(short)
        flat = cloud_of([(1.0, 2.0, 3.0)])
        flat.fields = flat.fields[:2]
        with pytest.raises(ValueError, match='x, y and z'):
            points_of_cloud(flat)
        whole = cloud_of([(1.0, 2.0, 3.0)])
        whole.fields[0].datatype = PointField.INT32
        with pytest.raises(ValueError, match='floating-point'):
            points_of_cloud(whole)
        overlong = cloud_of([(1.0, 2.0, 3.0)])
        overlong.fields[2].offset = 1000
        with pytest.raises(ValueError):
            points_of_cloud(overlong)

    def test_polygon(self):
        """The outline is sampled all round; polygons without a length are points."""
        corners = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
        assert len(points_of_polygon(corners, 0.1)) == pytest.approx(40, abs=4)
        assert len(points_of_polygon(np.zeros((3, 2)), 0.1)) == 3
        assert not len(points_of_polygon(np.empty((0, 2)), 0.1))
        assert len(points_of_polygon(corners * 1e9, 0.001)) < 200_000


BASE = {
    'polygons': ['Zone'],
    'observation_sources': ['scan'],
    'scan.type': 'scan',
    'source_timeout': 5.0,
    'state_topic': 'collision_monitor_state',
    'Zone.type': 'polygon',
    'Zone.points': SQUARE,
    'Zone.action_type': 'stop',
    'Zone.visualize': True,
}


class Bench:
    """A monitor or detector, a world of sensors around it, and what it publishes."""

    def __init__(self, ros, parameters=None, kind=CollisionMonitor, is_stamped=False):
        self.ros, self.velocities, self.states, self.shapes = ros, [], [], []
        self.place = (0.0, 0.0)
        self.node = ros.make(kind, {**BASE, **(parameters or {})})
        self.tester = ros.node()
        self.broadcaster = TransformBroadcaster(self.tester)
        self.tester.create_timer(0.02, self._move)
        twist = TwistStamped if is_stamped else Twist
        self.commands = self.tester.create_publisher(twist, 'cmd_vel_smoothed', 1)
        self.publishers = {}
        self.tester.create_subscription(twist, 'cmd_vel', self.velocities.append, 50)
        state = CollisionMonitorState if kind is CollisionMonitor else CollisionDetectorState
        topic = (
            'collision_monitor_state' if kind is CollisionMonitor else 'collision_detector_state'
        )
        self.tester.create_subscription(state, topic, self.states.append, 50)
        self.tester.create_subscription(PolygonStamped, 'Zone', self.shapes.append, 10)
        assert self.node.trigger_configure() == TransitionCallbackReturn.SUCCESS
        assert self.node.trigger_activate() == TransitionCallbackReturn.SUCCESS
        ready = self.node.transforms.buffer.can_transform_core
        ros.wait_until(lambda: ready('odom', 'base_footprint', _now())[0], what='the odometry')
        if kind is CollisionMonitor:
            ros.wait_until(self.commands.get_subscription_count, what='the monitor')
            ros.wait_until(lambda: self.node.count_subscribers('cmd_vel'), what='the listener')

    def _move(self):
        moved = TransformStamped()
        moved.header.frame_id, moved.child_frame_id = 'odom', 'base_footprint'
        moved.header.stamp = self.stamp()
        moved.transform.translation.x, moved.transform.translation.y = self.place
        moved.transform.rotation.w = 1.0
        self.broadcaster.sendTransform(moved)

    def stamp(self):
        return self.tester.get_clock().now().to_msg()

    def publish(self, message, topic='scan'):
        if hasattr(message, 'header'):
            message.header.stamp = self.stamp()
        if topic not in self.publishers:
            self.publishers[topic] = self.tester.create_publisher(type(message), topic, 5)
            self.ros.wait_until(self.publishers[topic].get_subscription_count, what=topic)
        self.publishers[topic].publish(message)

    def scan(self, distance):
        """Publish a scan of a wall all round."""
        message = LaserScan(angle_min=-math.pi, angle_increment=math.pi / 180, range_max=10.0)
        message.header.frame_id = 'base_footprint'
        message.range_min, message.ranges = 0.05, [distance] * 360
        self.publish(message)

    def drive(self, x, yaw=0.0, y=0.0):
        """Send one command; return the velocity that comes out of it."""
        count = len(self.velocities)
        self.command(x, yaw, y)
        self.ros.wait_until(lambda: len(self.velocities) > count, what='a velocity')
        out = self.velocities[-1]
        return out.linear.x, out.angular.z

    def command(self, x, yaw=0.0, y=0.0):
        """Send one command."""
        message = Twist()
        message.linear.x, message.linear.y, message.angular.z = x, y, yaw
        self.commands.publish(message)

    def settles(self, x, expected, yaw=0.0, what='the velocity'):
        """
        Send commands until the velocity along x is as expected.

        While the robot is stopped for long (`stop_pub_timeout`), none comes out of a command.
        """

        def is_settled():
            count = len(self.velocities)
            self.command(x, yaw)
            end_s = time.monotonic() + 0.2
            while len(self.velocities) == count and time.monotonic() < end_s:
                self.ros.executor.spin_once(timeout_sec=0.01)
            return self.velocities[count:] and self.velocities[-1].linear.x == pytest.approx(
                expected
            )

        self.ros.wait_until(is_settled, 10.0, what)


def _now():
    from rclpy.time import Time

    return Time()


class TestMonitor:
    def test_stop_and_go(self, ros):
        """A scan that is near stops the robot; without it the robot goes on at once."""
        bench = Bench(ros)
        bench.scan(2.0)
        bench.settles(0.4, 0.4)
        bench.scan(0.4)
        bench.settles(0.4, 0.0)
        ros.wait_until(lambda: bench.states[-1].action_type == CollisionMonitorState.STOP)
        assert bench.states[-1].polygon_name == 'Zone'
        bench.scan(2.0)
        bench.settles(0.4, 0.4)
        ros.wait_until(lambda: bench.states[-1].action_type == CollisionMonitorState.DO_NOTHING)
        assert len(bench.states) <= 4

    def test_slowdown_by_a_point_cloud(self, ros):
        """Points within the heights slow the robot down; others do not."""
        parameters = {
            'observation_sources': ['cloud'], 'cloud.type': 'pointcloud', 'cloud.topic': 'points',
            'cloud.min_height': 0.1, 'cloud.max_height': 0.5,
            'Zone.action_type': 'slowdown', 'Zone.slowdown_ratio': 0.25,
        }  # fmt: skip
        bench = Bench(ros, parameters)
        bench.publish(cloud_of([(0.3, 0.0, 0.05), (0.3, 0.0, 0.6)] * 5), 'points')
        bench.settles(0.4, 0.4)
        bench.publish(cloud_of([(0.3, 0.0, 0.3)] * 5), 'points')
        bench.settles(0.4, 0.1)

    def test_limit(self, ros):
        """The whole velocity is scaled so that the speed keeps to the limit."""
        bench = Bench(ros, {'Zone.action_type': 'limit', 'Zone.linear_limit': 0.1})
        bench.scan(0.4)
        bench.settles(0.4, 0.1, yaw=0.4)
        assert bench.drive(0.4, 0.4) == pytest.approx((0.1, 0.1))

    def test_approach_with_the_footprint_of_a_topic(self, ros):
        """The nearer the wall, the slower; the shape comes from the costmap's footprint."""
        bench = Bench(ros, {'Zone.action_type': 'approach', 'Zone.points': ''})
        bench.place = (3.0, -2.0)
        ros.spin(0.1)
        bench.scan(2.0)
        bench.settles(0.5, 0.5)
        footprint = PolygonStamped()
        footprint.header.frame_id = 'odom'
        footprint.polygon.points = [
            Point32(x=3.0 + x, y=-2.0 + y) for x, y in parse_points(SQUARE).tolist()
        ]
        bench.publish(footprint, 'local_costmap/published_footprint')
        for distance, expected in ((1.02, 0.275), (0.77, 0.15), (0.4, 0.0), (2.0, 0.5)):
            bench.publish(_points_ahead(distance))
            bench.settles(0.5, expected)

    def test_approach_without_a_shape_does_nothing(self, ros):
        """A zone whose shape has not come yet has no effect."""
        bench = Bench(ros, {'Zone.action_type': 'approach', 'Zone.points': ''})
        bench.scan(0.1)
        bench.settles(0.4, 0.4)

    def test_polygon_of_a_topic_in_another_frame(self, ros):
        """A polygon that comes in the frame of the odometry stays there while the robot moves."""
        bench = Bench(ros, {'Zone.points': '', 'Zone.polygon_sub_topic': 'danger'})
        polygon = PolygonStamped()
        polygon.header.frame_id = 'odom'
        polygon.polygon.points = [Point32(x=x, y=y) for x, y in parse_points(SQUARE).tolist()]
        bench.publish(polygon, 'danger')
        bench.scan(0.4)
        bench.settles(0.4, 0.0)
        bench.place = (3.0, 0.0)
        ros.spin(0.2)
        bench.scan(0.4)
        bench.settles(0.4, 0.4)
        bench.publish(PolygonStamped(), 'danger')
        bench.settles(0.4, 0.4)

    def test_circle_of_a_topic(self, ros):
        """A radius that is published is that of the circle."""
        shape = {'Zone.type': 'circle', 'Zone.points': '', 'Zone.polygon_sub_topic': 'radius'}
        bench = Bench(ros, shape)
        bench.scan(0.4)
        bench.settles(0.3, 0.3)
        bench.publish(Float32(data=0.5), 'radius')
        bench.settles(0.3, 0.0)
        for wrong in (math.nan, -1.0, math.inf):
            bench.publish(Float32(data=wrong), 'radius')
        bench.publish(Float32(data=0.3), 'radius')
        bench.settles(0.3, 0.3)

    def test_velocity_polygons(self, ros):
        """Which polygon counts depends on the velocity; the shape that counts is published."""
        parameters = {
            'Zone.type': 'velocity_polygon', 'Zone.points': '',
            'Zone.velocity_polygons': ['slow', 'fast'],
            'Zone.slow.points': '[[0.3, 0.3], [0.3, -0.3], [-0.3, -0.3], [-0.3, 0.3]]',
            'Zone.slow.linear_min': -0.2, 'Zone.slow.linear_max': 0.2,
            'Zone.slow.theta_min': -1.0, 'Zone.slow.theta_max': 1.0,
            'Zone.fast.points': '[[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0], [-1.0, 1.0]]',
            'Zone.fast.linear_min': 0.2, 'Zone.fast.linear_max': 1.0,
            'Zone.fast.theta_min': -1.0, 'Zone.fast.theta_max': 1.0,
        }  # fmt: skip
        bench = Bench(ros, parameters)
        bench.scan(0.8)
        bench.settles(0.5, 0.0)
        bench.settles(0.1, 0.1)
        assert bench.drive(0.5) == (0.0, 0.0)
        assert bench.drive(2.0) == (0.0, 0.0)
        ros.wait_until(lambda: bench.shapes and bench.shapes[-1].polygon.points[0].x == 1.0)

    def test_range_and_polygon_sources(self, ros):
        """Sonars and polygons of others stop the robot, too; sources_names selects."""
        parameters = {
            'observation_sources': ['sonar', 'others'],
            'sonar.type': 'range', 'sonar.topic': 'sonar',
            'others.type': 'polygon', 'others.topic': 'others',
            'source_timeout': 0.0,
            'polygons': ['Zone', 'Slow'], 'Zone.sources_names': ['sonar'],
            'Slow.type': 'circle', 'Slow.radius': 2.0, 'Slow.action_type': 'slowdown',
            'Slow.sources_names': ['others'],
        }  # fmt: skip
        bench = Bench(ros, parameters)
        bench.settles(0.4, 0.4)
        sonar = Range(field_of_view=0.5, min_range=0.1, max_range=4.0, range=1.0)
        sonar.header.frame_id = 'base_footprint'
        bench.publish(sonar, 'sonar')
        bench.settles(0.4, 0.4)
        other = PolygonInstanceStamped()
        other.header.frame_id = 'base_footprint'
        other.polygon.id = 7
        corners = ((0.2, 0.0), (0.4, 0.0), (0.4, 0.3))
        other.polygon.polygon.points = [Point32(x=x, y=y) for x, y in corners]
        bench.publish(other, 'others')
        bench.settles(0.4, 0.2)
        sonar.range = 0.3
        bench.publish(sonar, 'sonar')
        bench.settles(0.4, 0.0)

    def test_source_timeout_stops_the_robot(self, ros):
        """A sensor that is silent stops the robot; the state and the log say which."""
        bench = Bench(ros, {'source_timeout': 0.3})
        assert bench.drive(0.4) == (0.0, 0.0)
        ros.wait_until(lambda: bench.states and bench.states[-1].polygon_name == 'invalid source')
        bench.scan(2.0)
        bench.settles(0.4, 0.4)
        ros.spin(0.4)
        assert bench.drive(0.4) == (0.0, 0.0)
        bench.node.set_parameters([Parameter('scan.enabled', value=False)])
        assert bench.drive(0.4) == pytest.approx((0.4, 0.0))

    def test_frames_that_nobody_knows_stop_the_robot(self, ros):
        """Data in an unknown frame is no data."""
        bench = Bench(ros)
        message = LaserScan(ranges=[5.0], range_max=10.0)
        message.header.frame_id = 'nowhere'
        bench.publish(message)
        ros.spin(0.1)
        assert bench.drive(0.4) == (0.0, 0.0)

    def test_base_shift_correction(self, ros):
        """What was seen before the robot moved is where it is, seen from now."""
        bench = Bench(ros)
        bench.publish(_points_ahead(1.0))
        bench.settles(0.4, 0.4)
        bench.place = (0.7, 0.0)
        ros.spin(0.1)
        bench.settles(0.4, 0.0)

    def test_enabled_toggle_and_stop_timeout(self, ros):
        """Zones and the monitor can be switched off; zero is published for a while only."""
        bench = Bench(ros, {'stop_pub_timeout': 0.3})
        bench.scan(0.4)
        bench.settles(0.4, 0.0)
        bench.node.set_parameters([Parameter('Zone.enabled', value=False)])
        bench.settles(0.4, 0.4)
        bench.node.set_parameters([Parameter('Zone.enabled', value=True)])
        answer = ros.call(Toggle, 'collision_monitor/toggle', Toggle.Request(enable=False))
        assert answer.success and 'disabled' in answer.message
        bench.settles(0.4, 0.4)
        ros.call(Toggle, 'collision_monitor/toggle', Toggle.Request(enable=True))
        bench.settles(0.4, 0.0)
        ros.spin(0.4)
        count = len(bench.velocities)
        bench.commands.publish(Twist())
        ros.spin(0.2)
        assert len(bench.velocities) == count

    def test_changed_shapes(self, ros):
        """Points can be changed while the monitor runs; what cannot, is refused."""
        bench = Bench(ros)
        bench.scan(0.8)
        bench.settles(0.4, 0.4)
        wide = '[[1, 1], [1, -1], [-1, -1], [-1, 1]]'
        for name, value, is_taken in (
            ('points', '[[1, 1]]', False),
            ('type', 'circle', False),
            ('points', wide, True),
        ):
            answer = bench.node.set_parameters([Parameter(f'Zone.{name}', value=value)])[0]
            assert answer.successful is is_taken, answer.reason
        bench.settles(0.4, 0.0)
        bench.node.trigger_deactivate()
        bench.node.trigger_cleanup()
        bench.node.set_parameters([Parameter('Zone.type', value='circle')])
        bench.node.set_parameters([Parameter('Zone.radius', value=0.3)])
        assert bench.node.trigger_configure() == TransitionCallbackReturn.SUCCESS
        assert bench.node.trigger_activate() == TransitionCallbackReturn.SUCCESS
        ros.spin(0.3)
        forward = Twist()
        forward.linear.x = 0.4
        bench.tester.create_timer(0.05, lambda: bench.commands.publish(forward))
        bench.scan(0.8)
        count = len(bench.velocities)
        ros.wait_until(
            lambda: len(bench.velocities) > count and bench.velocities[-1] == forward,
            what='the command',
        )

    def test_commands_that_are_not_finite(self, ros):
        """A velocity that is not a number is not passed on."""
        bench = Bench(ros)
        bench.scan(2.0)
        bench.settles(0.4, 0.4)
        count = len(bench.velocities)
        for value in (math.nan, math.inf):
            message = Twist()
            message.angular.z = value
            bench.commands.publish(message)
        ros.spin(0.2)
        assert len(bench.velocities) == count
        assert bench.drive(1e30) == pytest.approx((1e30, 0.0))

    def test_empty_and_malformed_data(self, ros):
        """An empty scan is a free way; a cloud without fields stops the robot."""
        bench = Bench(ros)
        empty = LaserScan()
        empty.header.frame_id = 'base_footprint'
        bench.publish(empty)
        bench.settles(0.4, 0.4)
        parameters = {'observation_sources': ['cloud'], 'cloud.type': 'pointcloud'}
        bench.node.trigger_deactivate()
        other = Bench(ros, {**parameters, 'cloud.topic': 'cloud'})
        wrong = PointCloud2(width=5, height=1)
        wrong.header.frame_id = 'base_footprint'
        other.publish(wrong, 'cloud')
        ros.spin(0.1)
        assert other.drive(0.4) == (0.0, 0.0)

    def test_stamped_velocities(self, ros):
        """Stamped commands keep their header."""
        bench = Bench(ros, {'enable_stamped_cmd_vel': True}, is_stamped=True)
        bench.scan(2.0)
        ros.spin(0.1)
        message = TwistStamped()
        message.header.frame_id, message.twist.linear.x = 'base_link', 0.3
        bench.commands.publish(message)
        ros.wait_until(lambda: bench.velocities, what='a velocity')
        assert bench.velocities[-1] == message

    def test_deactivation_stops_the_robot(self, ros):
        """A monitor that is deactivated in motion publishes zero, and nothing more."""
        bench = Bench(ros)
        bench.scan(2.0)
        bench.settles(0.4, 0.4)
        bench.node.trigger_deactivate()
        ros.wait_until(lambda: bench.velocities[-1].linear.x == 0.0, what='zero')
        count = len(bench.velocities)
        bench.commands.publish(Twist())
        ros.spin(0.2)
        assert len(bench.velocities) == count

    def test_markers(self, ros):
        """The points of each sensor are markers with its name."""
        bench, markers = Bench(ros), []
        topic = 'collision_monitor/collision_points_marker'
        bench.tester.create_subscription(MarkerArray, topic, markers.append, 1)
        bench.scan(2.0)

        def marked():
            bench.drive(0.1)
            return markers and markers[-1].markers

        ros.wait_until(marked, what='markers')
        marker = markers[-1].markers[0]
        assert marker.ns == 'collision_points_scan' and len(marker.points) == 360

    @pytest.mark.parametrize(
        'change',
        [
            {'polygons': []},
            {'observation_sources': []},
            {'Zone.type': 'poligon'},
            {'Zone.type': ''},
            {'Zone.action_type': 'halt'},
            {'Zone.points': '[[1, 2]]'},
            {'Zone.points': ''},
            {'Zone.type': 'circle', 'Zone.points': ''},
            {'Zone.type': 'velocity_polygon'},
            {'Zone.sources_names': ['sonar']},
            {'Zone.slowdown_ratio': 1.5},
            {'Zone.min_points': 0},
            {'scan.type': 'lidar'},
            {'scan.source_timeout': -1.0},
            {'polygons': ['Zone', 'Other']},
        ],
    )
    def test_wrong_parameters(self, ros, change):
        """A monitor with wrong parameters is not configured."""
        node = ros.make(CollisionMonitor, {**BASE, **change})
        assert node.trigger_configure() == TransitionCallbackReturn.FAILURE


def _points_ahead(distance):
    """Return a scan of something small ahead."""
    message = LaserScan(angle_min=-0.02, angle_increment=0.01, range_max=10.0)
    message.header.frame_id, message.ranges = 'base_footprint', [distance] * 5
    return message


class TestDetector:
    def test_says_in_which_zones_something_is(self, ros):
        """The state names all zones, and which of them have something in them."""
        parameters = {
            'Zone.action_type': 'none', 'frequency': 50.0, 'polygons': ['Zone', 'Near'],
            'Near.type': 'circle', 'Near.radius': 0.2, 'Near.action_type': 'none',
        }  # fmt: skip
        bench = Bench(ros, parameters, kind=CollisionDetector)
        bench.scan(0.4)
        ros.wait_until(
            lambda: bench.states and list(bench.states[-1].detections) == [True, False],
            what='the detection',
        )
        assert bench.states[-1].polygons == ['Zone', 'Near']
        bench.scan(2.0)
        ros.wait_until(lambda: list(bench.states[-1].detections) == [False, False])
        bench.node.trigger_deactivate()

    def test_refuses_actions(self, ros):
        """Zones of the detector do nothing to the robot."""
        node = ros.make(CollisionDetector, BASE)
        assert node.trigger_configure() == TransitionCallbackReturn.FAILURE


class TestAttacks:
    """Data that no sensor should send: the monitor goes on, and never faster than without it."""

    @pytest.mark.parametrize(
        'change',
        [
            {'angle_min': math.nan},
            {'angle_increment': math.inf},
            {'range_min': math.nan},
            {'range_max': math.nan},
        ],
    )
    def test_scans_without_geometry_stop_the_robot(self, ros, change):
        """A scan whose angles or limits are no numbers tells nothing, and says so."""
        bench = Bench(ros)
        message = LaserScan(angle_increment=0.1, range_max=10.0, ranges=[0.4] * 60)
        message.header.frame_id = 'base_footprint'
        for name, value in change.items():
            setattr(message, name, value)
        bench.publish(message)
        ros.spin(0.1)
        assert bench.drive(0.4) == (0.0, 0.0)
        bench.scan(2.0)
        bench.settles(0.4, 0.4)

    def test_no_frame_and_no_stamp(self, ros):
        """A scan without a frame is no data; one without a stamp is of now."""
        bench = Bench(ros)
        bench.publish(LaserScan(angle_increment=0.1, range_max=10.0, ranges=[3.0] * 60))
        ros.spin(0.1)
        assert bench.drive(0.4) == (0.0, 0.0)
        message = _points_ahead(3.0)
        bench.publishers['scan'].publish(message)
        bench.settles(0.4, 0.4)

    def test_data_of_the_past_and_the_future(self, ros):
        """Data that is a minute old, or of the next one, is no data."""
        bench = Bench(ros)
        for offset_s in (-60, 60):
            message = _points_ahead(3.0)
            message.header.stamp = bench.stamp()
            message.header.stamp.sec += offset_s
            if 'scan' not in bench.publishers:
                bench.publish(_points_ahead(3.0))
                bench.settles(0.4, 0.4)
                bench.node._sources.all[0]._located.clear()
            bench.publishers['scan'].publish(message)
            ros.spin(0.1)
            assert bench.drive(0.4) == (0.0, 0.0)

    def test_shapes_of_topics_that_are_none(self, ros):
        """Polygons with too few corners, or such that are no numbers, leave the last one."""
        bench = Bench(ros, {'Zone.points': '', 'Zone.polygon_sub_topic': 'danger'})
        good = [Point32(x=x, y=y) for x, y in parse_points(SQUARE).tolist()]
        for corners in (good, good[:2], [], [Point32(x=math.nan)] * 4, [Point32(x=math.inf)] * 4):
            polygon = PolygonStamped()
            polygon.header.frame_id = 'base_footprint'
            polygon.polygon.points = corners
            bench.publish(polygon, 'danger')
            bench.scan(0.4)
            bench.settles(0.4, 0.0)

    def test_polygons_without_a_size(self, ros):
        """A zone all of whose corners are the same place has nothing inside."""
        for points in ('[[0, 0], [0, 0], [0, 0]]', '[[0, 0], [1, 0], [2, 0]]'):
            assert not Polygon(parse_points(points)).contains(cluster(0.5)).any()
        bench = Bench(ros, {'Zone.points': '[[1e30, 0], [-1e30, 1e30], [-1e30, -1e30]]'})
        bench.scan(2.0)
        bench.settles(0.4, 0.0)

    def test_many_points(self, ros):
        """A huge cloud is looked through in a moment."""
        parameters = {'observation_sources': ['cloud'], 'cloud.type': 'pointcloud'}
        bench = Bench(ros, {**parameters, 'cloud.topic': 'cloud', 'Zone.action_type': 'approach'})
        points = np.random.default_rng(1).uniform(1.5, 4.0, (100_000, 3))
        points[:, 2] = 0.3
        bench.publish(cloud_of(points), 'cloud')
        bench.settles(0.4, 0.4)
        bench.publish(cloud_of(np.full((1000, 3), 1e30)), 'cloud')
        bench.settles(0.4, 0.4)
