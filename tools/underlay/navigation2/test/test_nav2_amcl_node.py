# SPDX-License-Identifier: Apache-2.0
"""The node `amcl`: topics, services, transforms and lifecycle, in process."""

from __future__ import annotations

import array
import math
import time

from geometry_msgs.msg import PoseWithCovarianceStamped
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from nav2_amcl.amcl_node import AmclNode
from nav2_amcl.conversions import cloud_bytes, covariance_of, map_of, transform_message
from nav2_amcl.occupancy_map import OccupancyMap, RayCaster
from nav2_msgs.msg import ParticleCloud
from nav2_msgs.srv import SetInitialPose
from nav2_util.geometry import make_pose, planar_pose, Pose2D
from nav_msgs.msg import OccupancyGrid
import numpy as np
import pytest
from rclpy.duration import Duration
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, qos_profile_sensor_data, QoSProfile
from rclpy.serialization import deserialize_message
from rclpy.time import Time
from sensor_msgs.msg import LaserScan
from std_srvs.srv import Empty
from tf2_msgs.msg import TFMessage
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
ANGLES = np.radians(np.arange(360.0) - 180.0)


def make_room():
    """Return a room of 8 x 6 m with a corner cut off and a pillar."""
    cells = np.zeros((120, 160), np.int8)
    cells[[0, 1, -2, -1], :] = cells[:, [0, 1, -2, -1]] = 100
    cells[:40, :30] = cells[70:76, 110:116] = 100
    return cells


class Robot:
    """A robot in a room: publishes its map, transforms and scans; hears what AMCL publishes."""

    def __init__(self, ros):
        self.ros, self.node = ros, ros.node('robot')
        cells = make_room()
        self.caster = RayCaster(OccupancyMap(cells, 0.05))
        self.pose, self.odom = Pose2D(4.0, 3.0, 0.3), Pose2D(1.0, 1.0, -0.5)
        self.map = OccupancyGrid()
        self.map.header.frame_id = 'map'
        self.map.info.resolution, self.map.info.height, self.map.info.width = 0.05, *cells.shape
        self.map.data = array.array('b', cells.tobytes())
        self.maps = self.node.create_publisher(OccupancyGrid, 'map', LATCHED)
        self.scans = self.node.create_publisher(LaserScan, 'scan', qos_profile_sensor_data)
        self.starts = self.node.create_publisher(PoseWithCovarianceStamped, 'initialpose', 1)
        self.tf, self.static = TransformBroadcaster(self.node), None
        self.poses, self.clouds, self.transforms = [], [], []
        hear = self.node.create_subscription
        hear(PoseWithCovarianceStamped, 'amcl_pose', self.poses.append, LATCHED)
        hear(ParticleCloud, 'particle_cloud', self.clouds.append, qos_profile_sensor_data)
        hear(TFMessage, '/tf', self.hear_tf, 100)

    def hear_tf(self, message):
        """Keep the transforms from the map to odometry."""
        self.transforms += [t for t in message.transforms if t.child_frame_id == 'odom']

    def mount_laser(self):
        """Say where the laser is."""
        now = self.node.get_clock().now().to_msg()
        self.static = StaticTransformBroadcaster(self.node)
        self.static.sendTransform(
            transform_message(Pose2D(0.1, 0.0, 0.0), 'base_footprint', 'laser', now)
        )

    def walk(self, motion=Pose2D(0.0, 0.0, 0.0), tf_first=True):
        """Move, and publish a scan and the transforms."""
        self.pose, self.odom = self.pose @ motion, self.odom @ motion
        self.stamp = stamp = self.node.get_clock().now().to_msg()
        if tf_first:
            self.tf.sendTransform(transform_message(self.odom, 'odom', 'base_footprint', stamp))
        laser = self.pose @ Pose2D(0.1, 0.0, 0.0)
        ranges = self.caster.cast(np.array([[laser.x, laser.y]]), laser.yaw + ANGLES, 12.0)
        scan = LaserScan(
            angle_min=-math.pi, angle_increment=math.radians(1.0), range_min=0.1, range_max=12.0
        )
        scan.header.stamp, scan.header.frame_id = stamp, 'laser'
        scan.ranges = array.array('f', ranges.astype(np.float32).tobytes())
        self.scans.publish(scan)
        if not tf_first:
            self.ros.spin(0.05)
            self.tf.sendTransform(transform_message(self.odom, 'odom', 'base_footprint', stamp))
        self.ros.spin(0.02)

    def place(self, pose, frame='map'):
        """Publish an initial pose."""
        message = PoseWithCovarianceStamped()
        message.header.frame_id, message.pose.pose = frame, make_pose(pose)
        message.pose.covariance[0] = message.pose.covariance[7] = 0.25
        message.pose.covariance[35] = 0.07
        self.starts.publish(message)

    def pose_of_transform(self):
        """Return where the newest transform says that the robot is."""
        moved = self.transforms[-1].transform
        yaw = 2.0 * math.atan2(moved.rotation.z, moved.rotation.w)
        return Pose2D(moved.translation.x, moved.translation.y, yaw) @ self.odom


def change(ros, node, *transitions):
    """Change the state of a node by its service."""
    for each in transitions:
        request = ChangeState.Request()
        request.transition.id = each
        name = f'/{node.get_name()}/change_state'
        assert ros.call(ChangeState, name, request).success


def up(ros, node):
    """Configure and activate a node."""
    change(ros, node, Transition.TRANSITION_CONFIGURE, Transition.TRANSITION_ACTIVATE)


def down(ros, node):
    """Deactivate and clean up a node."""
    change(ros, node, Transition.TRANSITION_DEACTIVATE, Transition.TRANSITION_CLEANUP)


@pytest.fixture
def amcl(ros):
    """Return the node and a robot, both ready."""
    node = ros.make(AmclNode, {'random_seed': 3})
    up(ros, node)
    robot = Robot(ros)
    robot.maps.publish(robot.map)
    robot.mount_laser()
    ros.wait_until(lambda: node._has_map, what='the map')
    ros.wait_until(
        lambda: robot.scans.get_subscription_count() and robot.starts.get_subscription_count(),
        what='subscriptions',
    )
    return node, robot


def wait_for_poses(ros, robot, count=1):
    """Publish scans while the robot stands until poses have come."""

    def has_come():
        robot.walk()
        return len(robot.poses) >= count and len(robot.transforms) >= count

    ros.wait_until(has_come, what='poses')


def test_localises(ros, amcl):
    """From an initial pose that is half a metre off, AMCL finds the pose and follows it."""
    _, robot = amcl
    robot.place(robot.pose @ Pose2D(0.4, 0.3, 0.1))
    wait_for_poses(ros, robot)
    for _ in range(12):
        robot.walk(Pose2D(0.15, 0.0, 0.25))
    ros.wait_until(lambda: robot.poses[-1].header.stamp == robot.stamp, what='the newest pose')
    ros.wait_until(lambda: robot.clouds, what='particles')
    assert robot.pose_of_transform() == pytest.approx(robot.pose, abs=0.1)
    pose = robot.poses[-1]
    assert pose.header.frame_id == 'map'
    assert planar_pose(pose.pose.pose) == pytest.approx(robot.pose, abs=0.3)
    assert 0.0 < pose.pose.covariance[0] < 0.1
    assert robot.clouds[-1].header.frame_id == 'map'
    assert 500 <= len(robot.clouds[-1].particles) <= 2000


def test_transform_while_standing(ros, amcl):
    """The transform comes with each scan, valid for transform_tolerance beyond it; no poses do."""
    _, robot = amcl
    robot.place(robot.pose)
    wait_for_poses(ros, robot)
    robot.transforms.clear()
    poses = len(robot.poses)
    for _ in range(5):
        robot.walk()
    ros.wait_until(lambda: len(robot.transforms) >= 5, what='transforms')
    assert len(robot.poses) == poses
    transform = robot.transforms[-1]
    assert (transform.header.frame_id, transform.child_frame_id) == ('map', 'odom')
    ahead = Time.from_msg(transform.header.stamp) - Time.from_msg(robot.poses[-1].header.stamp)
    assert Duration(seconds=1.0) <= ahead < Duration(seconds=3.0)


def test_waits_for_transforms(ros, amcl):
    """A scan that comes before its transforms is used when they come."""
    _, robot = amcl
    robot.place(robot.pose)
    wait_for_poses(ros, robot)
    robot.walk(tf_first=True)
    poses = len(robot.poses)
    robot.walk(Pose2D(0.3, 0.0, 0.0), tf_first=False)
    ros.wait_until(lambda: len(robot.poses) > poses, what='a pose')


def test_services(ros, amcl):
    """The pose is set, an update forced, and the robot lost, by services."""
    _, robot = amcl
    request = SetInitialPose.Request()
    request.pose.header.frame_id, request.pose.pose.pose = 'map', make_pose(robot.pose)
    ros.call(SetInitialPose, 'set_initial_pose', request)
    wait_for_poses(ros, robot)
    poses = len(robot.poses)
    ros.call(Empty, 'request_nomotion_update')
    robot.walk()
    ros.wait_until(lambda: len(robot.poses) > poses, what='a pose without motion')
    ros.call(Empty, 'reinitialize_global_localization')
    robot.poses.clear()
    for _ in range(20):
        robot.walk(Pose2D(0.1, 0.0, 0.3))
    ros.wait_until(lambda: robot.poses, what='poses')
    assert robot.pose_of_transform() == pytest.approx(robot.pose, abs=0.15)


def test_refuses_poses_in_other_frames(ros, amcl):
    """An initial pose in another frame than the map is ignored."""
    node, robot = amcl
    robot.place(robot.pose, 'odom')
    ros.spin(0.3)
    assert not node._localizer.is_started


def test_up_and_down_twice(ros, amcl):
    """After a second start, the node goes on where it was."""
    node, robot = amcl
    robot.place(robot.pose)
    wait_for_poses(ros, robot)
    for _ in range(4):
        robot.walk(Pose2D(0.3, 0.0, 0.1))
    ros.spin(0.1)
    for _ in range(2):
        down(ros, node)
        robot.poses.clear()
        robot.walk()
        assert not robot.poses
        up(ros, node)
        ros.wait_until(lambda: node._has_map, what='the map again')
        wait_for_poses(ros, robot)
    assert robot.pose_of_transform() == pytest.approx(robot.pose, abs=0.2)
    down(ros, node)


def test_initial_pose_parameter(ros):
    """set_initial_pose starts at initial_pose, without a topic."""
    robot = Robot(ros)
    parameters = {
        'set_initial_pose': True,
        'initial_pose.x': 4.2,
        'initial_pose.y': 3,
        'initial_pose.yaw': 0.3,
        'tf_broadcast': False,
        'laser_model_type': 'beam',
        'robot_model_type': 'nav2_amcl::OmniMotionModel',
    }
    node = ros.make(AmclNode, parameters)
    up(ros, node)
    robot.maps.publish(robot.map)
    robot.mount_laser()

    def has_come():
        robot.walk()
        return robot.poses

    ros.wait_until(has_come, what='a pose')
    assert planar_pose(robot.poses[-1].pose.pose) == pytest.approx(robot.pose, abs=0.2)
    assert not robot.transforms


def test_first_map_only(ros, amcl):
    """With first_map_only, a later map is ignored; a map without cells always is."""
    node, robot = amcl
    node.set_parameters([Parameter('first_map_only', value=True)])
    grid = node._localizer.grid
    robot.maps.publish(robot.map)
    ros.spin(0.3)
    assert node._localizer.grid is grid
    node.set_parameters([Parameter('first_map_only', value=False)])
    robot.maps.publish(OccupancyGrid())
    ros.spin(0.3)
    assert node._localizer.grid is grid
    robot.maps.publish(robot.map)
    ros.wait_until(lambda: node._localizer.grid is not grid, what='the new map')


@pytest.mark.parametrize(
    ('parameters', 'word'),
    [
        ({'laser_model_type': 'likelihood_feld'}, 'likelihood_field'),
        ({'robot_model_type': 'differential'}, 'nav2_amcl::DifferentialMotionModel'),
        ({'min_particles': 3000}, 'max_particles'),
    ],
)
def test_wrong_parameters(ros, capfd, parameters, word):
    """The node is not configured with wrong values, and says which are right."""
    node = ros.make(AmclNode, parameters)
    request = ChangeState.Request()
    request.transition.id = Transition.TRANSITION_CONFIGURE
    assert not ros.call(ChangeState, '/amcl/change_state', request).success
    assert word in capfd.readouterr().err
    node.destroy_node()
    ros.nodes.remove(node)


def test_refuses_to_change_to_wrong_values(ros, amcl):
    """A change that does not fit the other values is refused, others hold at once."""
    node, _ = amcl
    result = node.set_parameters([Parameter('min_particles', value=5000)])[0]
    assert not result.successful
    assert 'max_particles' in result.reason
    assert node.set_parameters([Parameter('max_beams', value=30)])[0].successful
    assert node._localizer._settings.max_beams == 30


def test_says_what_is_missing(ros, capfd):
    """Without a map, a pose and scans, the node says so and what to do."""
    node = ros.make(AmclNode)
    up(ros, node)
    node._scan_s = time.monotonic() - 10.0
    text = ''

    def is_said():
        nonlocal text
        text += capfd.readouterr().err
        return "'/map'" in text and 'RViz' in text and "'/scan'" in text

    ros.wait_until(is_said, what='a warning')


def test_time_goes_back(ros, amcl):
    """After a reset of time, the node goes on from where the particles are."""
    node, robot = amcl
    robot.place(robot.pose)
    wait_for_poses(ros, robot)
    node._last_scan_ns += 10**15
    robot.poses.clear()
    wait_for_poses(ros, robot)
    assert robot.pose_of_transform() == pytest.approx(robot.pose, abs=0.2)


def test_bytes_of_a_cloud():
    """The bytes of a cloud are those of the message."""
    particles = np.array([[1.0, 2.0, 0.5], [-1.0, 0.0, math.pi]])
    stamp = Time(seconds=5, nanoseconds=7).to_msg()
    for frame in ('map', 'robot1/map', ''):
        data = cloud_bytes(particles, np.array([0.25, 0.75]), frame, stamp)
        cloud = deserialize_message(data, ParticleCloud)
        assert (cloud.header.frame_id, cloud.header.stamp) == (frame, stamp)
        found = [(*planar_pose(each.pose), each.weight) for each in cloud.particles]
        assert found[0] == pytest.approx((1.0, 2.0, 0.5, 0.25))
        assert found[1] == pytest.approx((-1.0, 0.0, math.pi, 0.75))


def test_covariance_and_map_of_messages():
    """The plane is taken out of a covariance; a map with too few cells is refused."""
    message = PoseWithCovarianceStamped()
    message.pose.covariance[1], message.pose.covariance[11] = 0.1, 0.2
    assert covariance_of(message).tolist() == [[0.0, 0.1, 0.0], [0.0, 0.0, 0.2], [0.0, 0.0, 0.0]]
    grid = OccupancyGrid()
    grid.info.width = grid.info.height = 3
    grid.info.resolution = 0.1
    with pytest.raises(ValueError, match='3 x 3'):
        map_of(grid)
