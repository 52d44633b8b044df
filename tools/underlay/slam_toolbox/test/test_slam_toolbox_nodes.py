# SPDX-License-Identifier: Apache-2.0
"""The nodes in process: scans and transforms in; map, pose, transforms and services out."""

from __future__ import annotations

import re

from geometry_msgs.msg import PoseWithCovarianceStamped, TransformStamped
from lifecycle_msgs.msg import State
from nav2_util.geometry import make_pose, make_quaternion, planar_pose, Pose2D
from nav_msgs.msg import MapMetaData, OccupancyGrid
from nav_msgs.srv import GetMap
import numpy as np
import pytest
from rclpy.duration import Duration
from rclpy.qos import DurabilityPolicy, qos_profile_sensor_data, QoSProfile
from rclpy.time import Time
from sensor_msgs.msg import LaserScan
from slam_toolbox.srv import (
    Clear,
    ClearQueue,
    DeserializePoseGraph,
    LoopClosure,
    Pause,
    Reset,
    SaveMap,
    SerializePoseGraph,
    ToggleInteractive,
)
from slam_toolbox_py.nodes import (
    AsynchronousSlamToolbox,
    LocalizationSlamToolbox,
    SynchronousSlamToolbox,
)
from slam_toolbox_py.poses import compose, inverse, rotation
from slam_world import ANGLES, room, walk
from std_msgs.msg import String
from std_srvs.srv import Empty
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster
from visualization_msgs.msg import MarkerArray

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
START = np.array([1.2, 2.0, 0.0])
QUICK = {
    'minimum_time_interval': 0.0,
    'minimum_travel_distance': 0.2,
    'minimum_travel_heading': 0.2,
    'map_update_interval': 0.2,
    'max_laser_range': 12.0,
}


class Rig:
    """A robot with a scanner that is turned and away from its middle, in a room."""

    def __init__(self, ros):
        self.ros, self.world, self.node = ros, room(), ros.node()
        self.rng = np.random.default_rng(1)
        self.scans = self.node.create_publisher(LaserScan, 'scan', qos_profile_sensor_data)
        self.moving = TransformBroadcaster(self.node)
        self.fixed = StaticTransformBroadcaster(self.node)
        self.mount = np.array([0.1, 0.02, 0.3])
        self.fixed.sendTransform(self._transform(self.mount, 'base_footprint', 'laser', Time()))
        self.got = {'pose': [], 'map': [], 'size': [], 'tf': []}
        for kind, name, key, qos in (
            (OccupancyGrid, 'map', 'map', LATCHED),
            (MapMetaData, 'map_metadata', 'size', LATCHED),
            (PoseWithCovarianceStamped, 'pose', 'pose', 10),
        ):
            self.node.create_subscription(kind, name, self.got[key].append, qos)
        from tf2_msgs.msg import TFMessage

        self.node.create_subscription(TFMessage, '/tf', self._on_tf, 100)

    def _on_tf(self, message):
        self.got['tf'] += [each for each in message.transforms if each.child_frame_id == 'odom']

    def _transform(self, pose, frame, child, time):
        message = TransformStamped(child_frame_id=child)
        message.header.frame_id, message.header.stamp = frame, time.to_msg()
        message.transform.translation.x = float(pose[0])
        message.transform.translation.y = float(pose[1])
        message.transform.rotation = make_quaternion(float(pose[2]))
        return message

    def see(self, pose, odometry=None, with_transform=True):
        """Publish odometry and a scan of the robot at a pose."""
        now = self.node.get_clock().now()
        told = pose if odometry is None else odometry
        if with_transform:
            self.moving.sendTransform(self._transform(told, 'odom', 'base_footprint', now))
        ranges = self.world.ranges(compose(np.asarray(pose, dtype=float), self.mount), self.rng)
        message = LaserScan(angle_min=float(ANGLES[0]), angle_max=float(ANGLES[-1]))
        message.angle_increment = float(ANGLES[1] - ANGLES[0])
        message.range_min, message.range_max = 0.1, 12.0
        message.ranges = ranges.astype(np.float32)
        message.header.frame_id, message.header.stamp = 'laser', now.to_msg()
        self.scans.publish(message)

    def start(self, node):
        """Configure and activate a node, and wait for the publisher of scans to be heard."""
        assert node.trigger_configure().name == 'SUCCESS'
        assert node.trigger_activate().name == 'SUCCESS'
        self.ros.wait_until(self.scans.get_subscription_count, what='the subscription of scans')
        return node

    def place(self, node, pose, odometry=None):
        """See from a pose until a scan of there was placed; return the pose message."""
        before = len(self.got['pose'])
        self.see(pose, odometry)

        def placed():
            if len(self.got['pose']) == before:
                self.ros.spin(0.05)
                if len(self.got['pose']) == before:
                    self.see(pose, odometry)
            return len(self.got['pose']) > before

        self.ros.wait_until(placed, what='a pose')
        return self.got['pose'][-1]

    def tour(self, node, count=8):
        """Place scans on a way through the room; return the last pose."""
        way = list(walk([(1.2, 2.0), (5.0, 1.6), (5.6, 3.6)]))[::8]
        for pose in way[:count]:
            self.place(node, pose)
        return way[:count][-1]


@pytest.fixture
def rig(ros):
    return Rig(ros)


def test_map_pose_and_transform_come_of_scans(ros, rig):
    """Scans of a moving robot become a latched map, poses, and the transform to odometry."""
    node = rig.start(ros.make(AsynchronousSlamToolbox, QUICK))
    assert node.get_name() == 'slam_toolbox'
    last = rig.tour(node)
    found = planar_pose(rig.got['pose'][-1].pose.pose)
    assert rig.got['pose'][-1].header.frame_id == 'map'
    assert np.hypot(found.x - last[0], found.y - last[1]) < 0.05
    covariance = rig.got['pose'][-1].pose.covariance.reshape(6, 6)
    assert 0.0 < covariance[0, 0] < 0.01
    assert 0.0 < covariance[5, 5] < 0.01
    ros.wait_until(lambda: rig.got['tf'], what='the transform')
    assert rig.got['tf'][-1].header.frame_id == 'map'
    ros.wait_until(lambda: len(rig.got['map']) > 2, what='maps')
    grid = rig.got['map'][-1]
    assert grid.header.frame_id == 'map'
    assert grid.info.resolution == pytest.approx(0.05)
    assert set(grid.data) == {-1, 0, 100}
    assert len(grid.data) == grid.info.width * grid.info.height
    ros.wait_until(lambda: rig.got['size'], what='the size')
    cells = np.array(grid.data).reshape(grid.info.height, grid.info.width)
    rows, columns = np.nonzero(cells == 100)
    origin = np.array([grid.info.origin.position.x, grid.info.origin.position.y])
    middles = (np.stack([columns, rows], axis=1) + 0.5) * 0.05 + origin
    assert (rig.world.distance_at(middles) < 0.1).mean() > 0.95
    late = []
    ros.node('late').create_subscription(OccupancyGrid, 'map', late.append, LATCHED)
    ros.wait_until(lambda: late, what='the latched map')


def test_transform_makes_up_for_odometry(ros, rig):
    """The transform from the map corrects odometry that slips."""
    node = rig.start(ros.make(AsynchronousSlamToolbox, QUICK))
    pose, odometry = START, START
    for _ in range(6):
        pose, step = compose(pose, [0.3, 0.0, 0.0]), np.array([0.33, 0.0, 0.03])
        odometry = compose(odometry, step)
        rig.place(node, pose, odometry)
    count = len(rig.got['tf'])
    ros.wait_until(lambda: len(rig.got['tf']) > count, what='the newest transform')
    moved = rig.got['tf'][-1].transform
    yaw = 2.0 * np.arctan2(moved.rotation.z, moved.rotation.w)
    found = compose(np.array([moved.translation.x, moved.translation.y, yaw]), odometry)
    # The first scan is where the map begins, and its odometry was wrong by one step already.
    begin = compose(compose(START, [0.33, 0.0, 0.03]), inverse(compose(START, [0.3, 0.0, 0.0])))
    assert np.hypot(*(found - compose(begin, pose))[:2]) < 0.06
    assert np.hypot(*(odometry - pose)[:2]) > 0.15


def test_save_map_writes_image_and_description(ros, rig, tmp_path):
    """save_map tells that there is no map yet, writes one, and says when it cannot."""
    node = rig.start(ros.make(AsynchronousSlamToolbox, QUICK))
    request = SaveMap.Request(name=String(data=str(tmp_path / 'home')))
    answer = ros.call(SaveMap, '/slam_toolbox/save_map', request)
    assert answer.result == SaveMap.Response.RESULT_NO_MAP_RECEIEVD
    rig.tour(node, 3)
    assert ros.call(SaveMap, '/slam_toolbox/save_map', request).result == 0
    assert sorted(each.name for each in tmp_path.iterdir()) == ['home.pgm', 'home.yaml']
    text = (tmp_path / 'home.yaml').read_text()
    assert 'image: home.pgm' in text
    assert 'resolution: 0.05' in text
    image = (tmp_path / 'home.pgm').read_bytes()
    magic, size, depth, pixels = image.split(b'\n', 3)
    assert (magic, depth) == (b'P5', b'255')
    assert int(size.split()[0]) * int(size.split()[1]) == len(pixels)
    assert set(pixels) == {0, 205, 254}
    request.name.data = str(tmp_path / 'nowhere' / 'home')
    assert ros.call(SaveMap, '/slam_toolbox/save_map', request).result == 255


def test_map_goes_through_a_file_and_the_robot_is_found(ros, rig, tmp_path):
    """serialize_map, reset, deserialize_map: the map is back, and mapping goes on in it."""
    node = rig.start(ros.make(AsynchronousSlamToolbox, QUICK))
    rig.tour(node)
    count, name = len(node.session.mapper.keyframes), str(tmp_path / 'home')
    request = SerializePoseGraph.Request(filename=name)
    assert ros.call(SerializePoseGraph, '/slam_toolbox/serialize_map', request).result == 0
    assert (tmp_path / 'home.posegraph').exists()
    ros.call(Reset, '/slam_toolbox/reset')
    assert not node.session.mapper.keyframes
    request = DeserializePoseGraph.Request(filename=name)
    ros.call(DeserializePoseGraph, '/slam_toolbox/deserialize_map', request)
    assert not node.session.mapper.keyframes, 'match_type was not set'
    request.match_type = DeserializePoseGraph.Request.START_AT_GIVEN_POSE
    request.initial_pose.x, request.initial_pose.y = 3.2, 1.9
    ros.call(DeserializePoseGraph, '/slam_toolbox/deserialize_map', request)
    assert len(node.session.mapper.keyframes) == count
    found = planar_pose(rig.place(node, [3.3, 1.8, 0.1], np.zeros(3)).pose.pose)
    assert np.hypot(found.x - 3.3, found.y - 1.8) < 0.05
    (tmp_path / 'home.posegraph').write_bytes(b'nonsense')
    ros.call(DeserializePoseGraph, '/slam_toolbox/deserialize_map', request)
    assert len(node.session.mapper.keyframes) == count + 1, 'a broken file changes nothing'


def test_nothing_to_serialize_is_a_failure(ros):
    """A map without scans is not written."""
    node = ros.make(AsynchronousSlamToolbox)
    node.trigger_configure()
    request = SerializePoseGraph.Request(filename='/tmp/never')
    answer = ros.call(SerializePoseGraph, '/slam_toolbox/serialize_map', request)
    assert answer.result == SerializePoseGraph.Response.RESULT_FAILED_TO_WRITE_FILE


def test_pause_and_reset(ros, rig):
    """Paused, no scan is taken, and the transform goes on; a reset forgets the map."""
    node = rig.start(ros.make(AsynchronousSlamToolbox, QUICK))
    rig.tour(node, 2)
    count = len(node.session.mapper.keyframes)
    assert ros.call(Pause, '/slam_toolbox/pause_new_measurements').status
    rig.see([2.5, 2.0, 0.5])
    transforms = len(rig.got['tf'])
    ros.wait_until(lambda: len(rig.got['tf']) > transforms + 2, what='transforms')
    assert len(node.session.mapper.keyframes) == count
    ros.call(Pause, '/slam_toolbox/pause_new_measurements')
    rig.place(node, [2.0, 2.0, 0.2])
    request = Reset.Request(pause_new_measurements=True)
    assert ros.call(Reset, '/slam_toolbox/reset', request).result == 0
    assert node.is_paused
    assert not node.session.mapper.keyframes
    ros.call(Reset, '/slam_toolbox/reset', Reset.Request(pause_new_measurements=False))
    rig.place(node, START)
    assert len(node.session.mapper.keyframes) == 1


def test_scan_waits_for_its_transform(ros, rig):
    """A scan that comes before its odometry is placed when that comes."""
    node = rig.start(ros.make(AsynchronousSlamToolbox, QUICK))
    rig.see(START, with_transform=False)
    ros.spin(0.2)
    assert not node.session.mapper.keyframes
    stamp = rig.node.get_clock().now()
    for moment in (stamp - Duration(seconds=1.0), stamp):
        rig.moving.sendTransform(rig._transform(START, 'odom', 'base_footprint', moment))
    ros.wait_until(lambda: node.session.mapper.keyframes, what='the first keyframe')


def test_lean_of_the_robot_is_taken_out(ros, rig):
    """What is seen while the robot leans is projected to the ground, around its heading."""
    from slam_toolbox_py.scan_intake import project, ScanIntake

    lean = np.deg2rad(4.0)

    class Buffer:
        def lookup_transform(self, target, source, _):
            message = TransformStamped()
            q = message.transform.rotation
            half_yaw, half_lean = 0.5, 0.5 * lean
            q.w, q.z = np.cos(half_yaw) * np.cos(half_lean), np.sin(half_yaw) * np.cos(half_lean)
            q.x, q.y = -np.sin(half_yaw) * np.sin(half_lean), np.cos(half_yaw) * np.sin(half_lean)
            message.transform.translation.x = 2.0
            return message

    message = LaserScan(angle_min=0.0, angle_increment=0.1, range_min=0.1, range_max=12.0)
    message.ranges = [2.0, 12.0, float('inf'), 0.01]
    message.header.frame_id = 'laser'
    intake = ScanIntake(Buffer(), 'odom', 'base', False, print)
    timed = intake.located(message)
    assert timed.odometry == pytest.approx([2.0, 0.0, 1.0])
    scan = project(timed, 0.0, 25.0)
    assert scan.points == pytest.approx(np.array([[2.0 * np.cos(lean), 0.0]]), abs=1e-9)
    assert rotation(0.0) == pytest.approx(np.eye(2))


def test_scans_of_a_fallen_robot_are_left_out(ros, rig):
    """A scanner that leans far sees the floor, and no walls."""
    node = rig.start(ros.make(AsynchronousSlamToolbox, QUICK))
    rig.place(node, START)
    upright = rig._transform

    def fallen(*arguments):
        message = upright(*arguments)
        message.transform.rotation.w, message.transform.rotation.y = np.cos(0.4), np.sin(0.4)
        return message

    rig._transform = fallen
    rig.see(START + [0.5, 0.0, 0.0])
    ros.spin(0.3)
    assert len(node.session.mapper.keyframes) == 1
    rig._transform = upright
    rig.place(node, START + [0.5, 0.0, 0.0])
    assert len(node.session.mapper.keyframes) == 2


def test_all_services_are_offered_and_answer(ros):
    """Names and types are those that clients call; what cannot be done is said, not hidden."""
    node = ros.make(SynchronousSlamToolbox, {'enable_interactive_mode': True})
    assert node.trigger_configure().name == 'SUCCESS'
    for kind, name in (
        (Clear, 'clear_changes'),
        (LoopClosure, 'manual_loop_closure'),
        (ToggleInteractive, 'toggle_interactive_mode'),
        (ClearQueue, 'clear_queue'),
    ):
        ros.call(kind, f'/slam_toolbox/{name}')
    assert not ros.call(GetMap, '/slam_toolbox/dynamic_map').map.data


def test_each_scan_is_processed_in_order(ros, rig):
    """The synchronous node leaves out none, also when they come at once."""
    node = rig.start(ros.make(SynchronousSlamToolbox, QUICK))
    poses = [START + [0.25 * i, 0.0, 0.0] for i in range(6)]
    rig.place(node, poses[0])
    for pose in poses[1:]:
        rig.see(pose)
        ros.executor.spin_once(timeout_sec=0.01)
    ros.wait_until(lambda: len(node.session.mapper.keyframes) == 6, what='all scans')


def test_graph_is_shown_to_those_who_look(ros, rig):
    """Keyframes and edges are markers in the frame of the map."""
    node = rig.start(ros.make(AsynchronousSlamToolbox, QUICK))
    shown = []
    rig.node.create_subscription(MarkerArray, 'slam_toolbox/graph_visualization', shown.append, 10)
    rig.tour(node, 3)
    ros.wait_until(
        lambda: shown and len(shown[-1].markers) == 3 and len(shown[-1].markers[1].points) == 3,
        what='markers',
    )
    assert {each.header.frame_id for each in shown[-1].markers[1:]} == {'map'}
    assert len(shown[-1].markers[2].points) == 4


def test_localization_in_a_map(ros, rig, tmp_path):
    """A robot is found near an initial pose in a map that stays as it is."""
    mapping = rig.start(ros.make(AsynchronousSlamToolbox, QUICK))
    rig.tour(mapping, 20)
    mapping.session.save(str(tmp_path / 'home'))
    mapping.trigger_deactivate()
    mapping.trigger_cleanup()
    told = {**QUICK, 'map_file_name': str(tmp_path / 'home'), 'map_start_pose': [1.3, 2.1, 0.1]}
    node = rig.start(ros.make(LocalizationSlamToolbox, told, node_name='localizer'))
    count = len(node.session.mapper.keyframes)
    ros.wait_until(lambda: node.session.grid() is not None, what='the map')
    found = planar_pose(rig.place(node, START, np.zeros(3)).pose.pose)
    assert np.hypot(found.x - START[0], found.y - START[1]) < 0.05
    initial = PoseWithCovarianceStamped()
    initial.header.frame_id = 'map'
    initial.pose.pose = make_pose(Pose2D(3.4, 2.0, 0.1))
    publisher = rig.node.create_publisher(PoseWithCovarianceStamped, 'initialpose', 10)
    ros.wait_until(publisher.get_subscription_count, what='the subscription')
    publisher.publish(initial)
    ros.spin(0.1)
    found = planar_pose(rig.place(node, [3.2, 1.8, 0.0], [2.0, 0.0, 0.0]).pose.pose)
    assert np.hypot(found.x - 3.2, found.y - 1.8) < 0.05
    assert len(node.session.mapper.keyframes) == count
    ros.call(Empty, '/slam_toolbox/clear_localization_buffer')


def test_clock_that_jumps_back_keeps_the_map(ros, rig):
    """After a reset of simulated time the robot is found again, and transforms go on."""
    from rosgraph_msgs.msg import Clock

    clock = rig.node.create_publisher(Clock, '/clock', 10)
    told = {**QUICK, 'use_sim_time': True}
    node = ros.make(AsynchronousSlamToolbox, told)
    rig.time_s = 100.0

    class Now:
        def now(self):
            rig.time_s += 0.1
            time = Time(nanoseconds=int(rig.time_s * 1e9))
            clock.publish(Clock(clock=time.to_msg()))
            ros.spin(0.03)
            return time

    rig.node.get_clock = Now
    rig.start(node)
    rig.place(node, START)
    rig.place(node, START + [0.4, 0.0, 0.0])
    rig.time_s, count = 5.0, len(node.session.mapper.keyframes)
    found = planar_pose(rig.place(node, START).pose.pose)
    assert np.hypot(found.x - START[0], found.y - START[1]) < 0.05
    assert len(node.session.mapper.keyframes) == count + 1

    def is_fresh():
        Now().now()
        return rig.got['tf'] and rig.got['tf'][-1].header.stamp.sec < 50

    ros.wait_until(is_fresh, what='a transform of the new time')


def test_bad_parameters_are_configuration_errors(ros, tmp_path):
    """A map that is not there, and a pose of two numbers, keep the node unconfigured."""
    for parameters in (
        {'map_file_name': str(tmp_path / 'nowhere')},
        {'map_start_pose': [1.0, 2.0]},
        {'resolution': -1.0},
        {'mode': 'mappin'},
    ):
        node = ros.make(AsynchronousSlamToolbox, parameters)
        assert node.trigger_configure().name == 'FAILURE'


def test_lifecycle_can_be_walked_through_again(ros, rig):
    """Deactivated, it hears no scans; cleaned up and configured, it begins anew."""
    node = rig.start(ros.make(AsynchronousSlamToolbox, QUICK))
    rig.place(node, START)
    node.trigger_deactivate()
    ros.wait_until(lambda: not rig.scans.get_subscription_count(), what='the end')
    node.trigger_activate()
    ros.wait_until(rig.scans.get_subscription_count, what='the subscription of scans')
    rig.place(node, START + [0.4, 0.0, 0.0])
    assert len(node.session.mapper.keyframes) == 2
    node.trigger_deactivate()
    node.trigger_cleanup()
    rig.start(node)
    assert not node.session.mapper.keyframes
    rig.place(node, START)
    assert node._state_machine.current_state[0] == State.PRIMARY_STATE_ACTIVE


def test_parameter_files_of_others_are_understood(ros, tmp_path, capfd):
    """Every documented name is taken, with integers for numbers, or told to have no effect."""
    file = tmp_path / 'mapper_params.yaml'
    lines = """
        solver_plugin: solver_plugins::CeresSolver
        ceres_linear_solver: SPARSE_NORMAL_CHOLESKY
        ceres_preconditioner: SCHUR_JACOBI
        ceres_trust_strategy: LEVENBERG_MARQUARDT
        ceres_dogleg_type: TRADITIONAL_DOGLEG
        ceres_loss_function: None
        odom_frame: odom
        map_frame: map
        base_frame: base_link
        scan_topic: /scan
        use_map_saver: true
        mode: mapping
        map_start_pose: [0, 0, 0]
        map_start_at_dock: true
        debug_logging: false
        throttle_scans: 1
        transform_publish_period: 0.02
        map_update_interval: 5
        resolution: 0.05
        min_laser_range: 0.0
        max_laser_range: 20
        minimum_time_interval: 0.5
        transform_timeout: 0.2
        tf_buffer_duration: 30.
        stack_size_to_use: 40000000
        enable_interactive_mode: true
        use_scan_matching: true
        use_scan_barycenter: true
        minimum_travel_distance: 0.5
        minimum_travel_heading: 0.5
        scan_buffer_size: 10
        scan_buffer_maximum_scan_distance: 10.0
        link_match_minimum_response_fine: 0.1
        link_scan_maximum_distance: 1.5
        loop_search_maximum_distance: 3.0
        do_loop_closing: true
        loop_match_minimum_chain_size: 10
        loop_match_maximum_variance_coarse: 3.0
        loop_match_minimum_response_coarse: 0.35
        loop_match_minimum_response_fine: 0.45
        correlation_search_space_dimension: 0.5
        correlation_search_space_resolution: 0.01
        correlation_search_space_smear_deviation: 0.1
        loop_search_space_dimension: 8.0
        loop_search_space_resolution: 0.05
        loop_search_space_smear_deviation: 0.03
        distance_variance_penalty: 0.5
        angle_variance_penalty: 1.0
        fine_search_angle_offset: 0.00349
        coarse_search_angle_offset: 0.349
        coarse_angle_resolution: 0.0349
        minimum_angle_penalty: 0.9
        minimum_distance_penalty: 0.5
        use_response_expansion: true
        min_pass_through: 2
        occupancy_threshold: 0.1
    """
    file.write_text(f'slam_toolbox:\n    ros__parameters:{lines}')
    node = ros.make(AsynchronousSlamToolbox, cli_args=['--ros-args', '--params-file', str(file)])
    assert node.trigger_configure().name == 'SUCCESS'
    assert node.told.current.base_frame == 'base_link'
    assert node.told.current.max_laser_range == 20.0
    output = capfd.readouterr().err
    assert 'There is no parameter' not in output
    assert re.search("'ceres_linear_solver', .* have no effect", output)


def test_settings_change_while_it_runs(ros):
    """`ros2 param set` has effect, and refuses what is not allowed."""
    from rclpy.parameter import Parameter

    node = ros.make(AsynchronousSlamToolbox)
    node.trigger_configure()
    assert node.set_parameters([Parameter('minimum_travel_distance', value=0.1)])[0].successful
    assert node.session.mapper.settings.minimum_travel_distance == 0.1
    assert not node.set_parameters([Parameter('occupancy_threshold', value=2.0)])[0].successful
