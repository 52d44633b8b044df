# SPDX-License-Identifier: Apache-2.0
"""The loopback simulator: a robot that does what it is told, and sees the map."""

from __future__ import annotations

import array
import math
import time

from geometry_msgs.msg import PoseWithCovarianceStamped, Twist, TwistStamped
from nav2_amcl.amcl_node import AmclNode
from nav2_amcl.occupancy_map import OccupancyMap
from nav2_loopback_sim.loopback_robot import LaserShape, LoopbackRobot, SimulatedLaser
from nav2_loopback_sim.loopback_simulator import _Rhythm, LoopbackSimulator
from nav2_util.geometry import make_pose, planar_pose, Pose2D
from nav2_util.twist import Velocity
from nav_msgs.msg import OccupancyGrid, Odometry
from nav_msgs.srv import GetMap
import numpy as np
import pytest
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.time import Time
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage
from tf2_ros import Buffer, TransformException, TransformListener


def room_cells():
    """Return a room of 4 x 4 m."""
    cells = np.zeros((80, 80), np.int8)
    cells[[0, -1], :] = cells[:, [0, -1]] = 100
    return cells


def test_robot_waits_to_be_placed():
    """It does not move before it is in the map."""
    robot = LoopbackRobot()
    robot.command(Velocity(1.0, 0.0, 0.0))
    robot.step(0.5)
    assert robot.odom == Pose2D(0.0, 0.0, 0.0)
    assert robot.velocity.is_zero
    assert robot.pose_in_map is None


def test_robot_moves_in_arcs():
    """It goes on the exact arc of a velocity, in any direction."""
    robot = LoopbackRobot(timeout_s=10.0)
    robot.place(Pose2D(0.0, 0.0, 0.0))
    robot.command(Velocity(1.0, 0.0, 1.0))
    for _ in range(4):
        robot.step(math.pi / 4.0)
    assert robot.odom == pytest.approx((0.0, 2.0, math.pi))
    robot.command(Velocity(0.0, 0.5, 0.0))
    robot.step(1.0)
    assert robot.odom == pytest.approx((0.0, 1.5, math.pi))


def test_robot_stops_without_commands():
    """A command holds for a second."""
    robot = LoopbackRobot(timeout_s=1.0)
    robot.place(Pose2D(0.0, 0.0, 0.0))
    robot.command(Velocity(1.0, 0.0, 0.0))
    for _ in range(30):
        robot.step(0.1)
    assert robot.odom.x == pytest.approx(1.0, abs=0.11)
    assert robot.velocity.is_zero


def test_robot_is_carried():
    """Another initial pose moves the robot in the map; odometry goes on."""
    robot = LoopbackRobot()
    robot.place(Pose2D(1.0, 1.0, 0.0))
    robot.command(Velocity(1.0, 0.0, 0.0))
    robot.step(0.5)
    odom = robot.odom
    robot.place(Pose2D(5.0, 5.0, 2.0))
    assert robot.odom == odom
    assert robot.pose_in_map == pytest.approx((5.0, 5.0, 2.0))


def test_laser_sees_walls():
    """Ranges are those to the walls; where nothing is in range, inf or less than the maximum."""
    shape = LaserShape(-math.pi, math.pi, math.pi / 2.0, 0.05, 30.0)
    assert shape.count == 5
    laser = SimulatedLaser(shape)
    assert np.isinf(laser.scan(Pose2D(0.0, 0.0, 0.0))).all()
    laser.set_map(OccupancyMap(room_cells(), 0.05))
    assert laser.scan(Pose2D(1.0, 2.0, 0.0)) == pytest.approx(
        [0.95, 1.95, 2.95, 1.95, 0.95], abs=0.06
    )
    assert np.isinf(laser.scan(None)).all()
    near = SimulatedLaser(LaserShape(0.0, 1.0, 0.5, 0.05, 1.0, uses_inf=False))
    near.set_map(OccupancyMap(room_cells(), 0.05))
    assert near.scan(Pose2D(2.0, 2.0, 0.0)).tolist() == pytest.approx([0.9] * 3)
    assert near.scan(Pose2D(3.96, 2.0, 0.0))[0] == pytest.approx(0.05)


@pytest.mark.parametrize('period_s', [0.1, 0.25])
def test_rhythm(period_s):
    """What is due once in a period comes as often in ten seconds, also after a jump of time."""
    rhythm = _Rhythm(period_s)
    for start_s in (0, 1000, 500):
        times = start_s * 10**9 + np.arange(0, 10 * 10**9, 17_000_000)
        count = sum(rhythm.is_due(int(now_ns)) for now_ns in times)
        assert count == pytest.approx(10.0 / period_s, abs=1.1)


class Observer:
    """Commands the simulator, and hears what it publishes."""

    def __init__(self, ros):
        self.node = ros.node('observer')
        self.odometry, self.scans, self.clocks, self.children = [], [], [], set()
        hear = self.node.create_subscription
        hear(Odometry, 'odom', self.odometry.append, 10)
        hear(LaserScan, 'scan', self.scans.append, 10)
        hear(Clock, '/clock', self.clocks.append, 10)
        hear(TFMessage, '/tf', self.hear_tf, 100)
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self.node)
        self.starts = self.node.create_publisher(PoseWithCovarianceStamped, 'initialpose', 10)
        self.twists = self.node.create_publisher(Twist, 'cmd_vel', 10)
        self.stamped = self.node.create_publisher(TwistStamped, 'cmd_vel_stamped', 10)

    def hear_tf(self, message):
        """Remember which frames move."""
        self.children.update(each.child_frame_id for each in message.transforms)

    def place(self, pose):
        """Publish an initial pose."""
        message = PoseWithCovarianceStamped()
        message.header.frame_id, message.pose.pose = 'map', make_pose(pose)
        self.starts.publish(message)

    def pose(self, frame='base_footprint'):
        """Return where a frame is in the map, None if that is not known."""
        try:
            moved = self.buffer.lookup_transform('map', frame, Time()).transform
        except TransformException:
            return None
        yaw = 2.0 * math.atan2(moved.rotation.z, moved.rotation.w)
        return Pose2D(moved.translation.x, moved.translation.y, yaw)


def offer_map(ros):
    """Offer the map of a room as map_server does."""

    def answer(_, response):
        info = response.map.info
        info.resolution, info.width, info.height = 0.05, 80, 80
        response.map.data = array.array('b', room_cells().tobytes())
        return response

    ros.node('map_server').create_service(GetMap, 'map_server/map', answer)


def start(ros, **parameters):
    """Start a simulator and an observer."""
    observer = Observer(ros)
    node = ros.make(LoopbackSimulator, {'update_duration': 0.02, **parameters})
    ros.wait_until(
        lambda: (
            observer.starts.get_subscription_count()
            and observer.node.count_publishers('/odom')
            and observer.odometry
        ),
        what='the simulator',
    )
    return node, observer


def test_stands_until_placed(ros):
    """Before an initial pose, odometry stands and the map is not known to it; then it drives."""
    _, observer = start(ros)
    ros.wait_until(observer.twists.get_subscription_count, what='cmd_vel')
    twist = Twist()
    twist.linear.x, twist.linear.y, twist.angular.z = 0.3, 0.2, 0.5
    observer.twists.publish(twist)
    ros.spin(0.3)
    assert observer.pose() is None
    assert planar_pose(observer.odometry[-1].pose.pose) == Pose2D(0.0, 0.0, 0.0)
    assert observer.children == {'base_footprint'}
    observer.place(Pose2D(1.0, 2.0, 0.5))
    assert ros.wait_until(observer.pose, what='the pose') == pytest.approx((1.0, 2.0, 0.5))

    observer.twists.publish(twist)

    def has_moved():
        return observer.pose().distance_to(Pose2D(1.0, 2.0, 0.5)) > 0.3

    ros.wait_until(has_moved, what='motion')
    moving = observer.odometry[-1].twist.twist
    assert (moving.linear.x, moving.linear.y, moving.angular.z) == (0.3, 0.2, 0.5)
    assert observer.odometry[-1].child_frame_id == 'base_footprint'
    ros.wait_until(lambda: observer.odometry[-1].twist.twist.linear.x == 0.0, what='a stop')


def test_scans_the_map(ros):
    """Scans show the map of map_server around the robot; the laser's frame is published."""
    offer_map(ros)
    _, observer = start(ros, scan_range_max=12.0)
    observer.place(Pose2D(1.0, 2.0, 0.0))
    found = ros.wait_until(
        lambda: next((s for s in observer.scans[-1:] if math.isfinite(s.ranges[0])), None),
        what='a scan of the map',
    )
    assert found.header.frame_id == 'base_scan'
    assert len(found.ranges) == 241
    assert found.ranges[120] == pytest.approx(2.95, abs=0.1)
    assert found.ranges[0] == pytest.approx(0.95, abs=0.1)
    assert ros.wait_until(lambda: observer.pose('base_scan'), what='the frame of the laser')


def test_time_runs_faster(ros):
    """With speed 10, simulated time and motion are about ten times as fast as real ones."""
    _, observer = start(ros, speed=10.0, update_duration=0.05)
    observer.place(Pose2D(0.0, 0.0, 0.0))
    ros.wait_until(observer.pose, what='the pose')
    twist = Twist()
    twist.linear.x = 0.5
    began_s, start_ns = time.monotonic(), Time.from_msg(observer.clocks[-1].clock).nanoseconds

    observer.node.create_timer(0.02, lambda: observer.twists.publish(twist))

    def elapsed_s():
        return (Time.from_msg(observer.clocks[-1].clock).nanoseconds - start_ns) * 1e-9

    ros.wait_until(lambda: elapsed_s() > 10.0, what='ten simulated seconds')
    assert time.monotonic() - began_s < elapsed_s()
    assert observer.pose().x == pytest.approx(5.0, rel=0.2)
    stamps = [Time.from_msg(each.header.stamp).nanoseconds for each in observer.odometry]
    assert stamps == sorted(stamps)


def test_takes_stamped_commands(ros):
    """With enable_stamped_cmd_vel, commands have a header; frames have the names given."""
    observer = Observer(ros)
    ros.make(
        LoopbackSimulator,
        {
            'enable_stamped_cmd_vel': True,
            'base_frame_id': 'base_link',
            'publish_clock': False,
            'publish_map_odom_tf': False,
        },
        cli_args=['--ros-args', '-r', 'cmd_vel:=cmd_vel_stamped'],
    )
    ros.wait_until(observer.stamped.get_subscription_count, what='cmd_vel')
    ros.wait_until(observer.starts.get_subscription_count, what='initialpose')
    observer.place(Pose2D(0.0, 0.0, 0.0))
    command = TwistStamped()
    command.twist.angular.z = 1.0

    observer.node.create_timer(0.1, lambda: observer.stamped.publish(command))

    def has_turned():
        newest = observer.odometry[-1:]
        return newest and planar_pose(newest[0].pose.pose).yaw > 0.3

    ros.wait_until(has_turned, what='motion')
    assert observer.children == {'base_link'}
    assert not observer.clocks
    age_s = time.time() - Time.from_msg(observer.odometry[-1].header.stamp).nanoseconds * 1e-9
    assert age_s < 60.0, 'the time is not that of the machine'


def test_amcl_localises_it(ros):
    """AMCL follows the simulated robot in simulated time that runs five times as fast."""
    grid = OccupancyGrid()
    grid.header.frame_id = 'map'
    grid.info.resolution, grid.info.width, grid.info.height = 0.05, 80, 80
    cells = room_cells()
    cells[:20, :30] = 100
    grid.data = array.array('b', cells.tobytes())

    def answer(_, response):
        response.map = grid
        return response

    server = ros.node('map_server')
    server.create_service(GetMap, 'map_server/map', answer)
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    maps = server.create_publisher(OccupancyGrid, 'map', latched)
    maps.publish(grid)
    parameters = {'speed': 5.0, 'update_duration': 0.05, 'publish_map_odom_tf': False}
    simulator = ros.make(LoopbackSimulator, parameters)
    amcl = ros.make(AmclNode, {'use_sim_time': True, 'random_seed': 1})
    observer = Observer(ros)
    amcl.trigger_configure()
    amcl.trigger_activate()
    ros.wait_until(lambda: simulator._laser.has_map and amcl._has_map, what='the maps')
    ros.wait_until(lambda: observer.starts.get_subscription_count() == 2, what='initialpose')
    observer.place(Pose2D(2.5, 2.0, 0.5))
    ros.wait_until(observer.pose, what='the pose')
    twist = Twist()
    twist.linear.x, twist.angular.z = 0.3, 0.5
    observer.node.create_timer(0.05, lambda: observer.twists.publish(twist))
    ros.wait_until(
        lambda: amcl._localizer.estimate and simulator._robot.odom.y > 1.0, what='motion'
    )
    assert observer.pose() == pytest.approx(simulator._robot.pose_in_map, abs=0.2)
