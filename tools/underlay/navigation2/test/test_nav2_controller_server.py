# SPDX-License-Identifier: Apache-2.0
"""The controller server in process: a robot that follows its commands, its odometry and tf."""

from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Time
from geometry_msgs.msg import PointStamped, PoseStamped, TransformStamped, Twist, TwistStamped
from nav2_controller.controller_server import ControllerServer
from nav2_msgs.action import FollowPath
from nav2_msgs.msg import SpeedLimit
from nav2_util.geometry import make_path, make_quaternion, planar_pose, Pose2D
from nav_msgs.msg import OccupancyGrid, Odometry, Path
import pytest
from rclpy.action import ActionClient
from rclpy.lifecycle import TransitionCallbackReturn
from rclpy.qos import DurabilityPolicy, QoSProfile
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster
from visualization_msgs.msg import Marker, MarkerArray

RPP = 'nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController'
MPPI = 'nav2_mppi_controller::MPPIController'
RATE_HZ = 50.0
Code = FollowPath.Result
PARAMETERS = {
    'controller_frequency': 30.0,
    'costmap_update_timeout': 30.0,  # the machine may be busy with other tests
    'controller_plugins': ['FollowPath', 'Slow'],
    'FollowPath.plugin': RPP,
    'FollowPath.desired_linear_vel': 1.5,
    'FollowPath.lookahead_dist': 0.4,
    'FollowPath.rotate_to_heading_angular_vel': 3.0,
    'FollowPath.max_angular_accel': 20.0,
    'FollowPath.regulated_linear_scaling_min_radius': 0.2,
    'FollowPath.min_approach_linear_velocity': 0.3,
    'Slow.plugin': RPP.replace('::', '/'),
    'Slow.desired_linear_vel': 0.2,
    'progress_checker.movement_time_allowance': 5.0,
    'local_costmap.local_costmap.global_frame': 'odom',
    'local_costmap.local_costmap.robot_base_frame': 'base_link',
    'local_costmap.local_costmap.rolling_window': True,
    'local_costmap.local_costmap.width': 3,
    'local_costmap.local_costmap.height': 3,
    'local_costmap.local_costmap.resolution': 0.05,
    'local_costmap.local_costmap.robot_radius': 0.2,
    'local_costmap.local_costmap.update_frequency': 10.0,
    'local_costmap.local_costmap.plugins': ['static_layer', 'inflation_layer'],
    'local_costmap.local_costmap.static_layer.plugin': 'nav2_costmap_2d::StaticLayer',
    'local_costmap.local_costmap.static_layer.map_topic': '/map',
    'local_costmap.local_costmap.inflation_layer.plugin': 'nav2_costmap_2d::InflationLayer',
}


class Robot:
    """Does at once what it is told, and publishes where it is; the map is 1 m beside odom."""

    def __init__(self, ros, stamped=False):
        self.pose, self.velocity = Pose2D(0.0, 0.0, 0.0), (0.0, 0.0)
        self.commands, self.is_stuck, self.has_tf = [], False, True
        self.node = ros.node('robot')
        self.odometry = self.node.create_publisher(Odometry, 'odom', 10)
        self.node.create_subscription(TwistStamped if stamped else Twist, 'cmd_vel', self.take, 10)
        self.tf = TransformBroadcaster(self.node)
        self.static = StaticTransformBroadcaster(self.node)
        self.static.sendTransform(self.transform('map', 'odom', Pose2D(1.0, 0.0, 0.0)))
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.map = self.node.create_publisher(OccupancyGrid, 'map', latched)
        self.publish_map()
        self.node.create_timer(1.0 / RATE_HZ, self.step)

    def publish_map(self, wall_x=None):
        """Publish a map of 12 m x 8 m, with a wall across it or without."""
        grid = OccupancyGrid()
        grid.header.frame_id = 'map'
        grid.info.resolution, grid.info.width, grid.info.height = 0.1, 120, 80
        grid.info.origin.position.x, grid.info.origin.position.y = -5.0, -4.0
        grid.info.origin.orientation.w = 1.0
        data = [0] * (120 * 80)
        if wall_x is not None:
            column = int((wall_x + 5.0) / 0.1)
            for row in range(80):
                data[row * 120 + column] = 100
        grid.data = data
        self.map.publish(grid)

    def transform(self, frame, child, pose):
        message = TransformStamped(child_frame_id=child)
        message.header.frame_id = frame
        message.header.stamp = self.node.get_clock().now().to_msg()
        message.transform.translation.x = pose.x
        message.transform.translation.y = pose.y
        message.transform.rotation = make_quaternion(pose.yaw)
        return message

    def take(self, message):
        twist = getattr(message, 'twist', message)
        self.velocity = twist.linear.x, twist.angular.z
        self.commands.append(message)

    def step(self):
        if not self.is_stuck:
            v, w = self.velocity
            self.pose = self.pose @ Pose2D(v / RATE_HZ, 0.0, w / RATE_HZ)
        if not self.has_tf:
            return
        odometry = Odometry(child_frame_id='base_link')
        odometry.header.frame_id = 'odom'
        odometry.twist.twist.linear.x, odometry.twist.twist.angular.z = self.velocity
        self.odometry.publish(odometry)
        self.tf.sendTransform(self.transform('odom', 'base_link', self.pose))


class Story:
    """A server that is active, a robot, and a client."""

    def __init__(self, ros, parameters=None):
        self.ros = ros
        given = {**PARAMETERS, **(parameters or {})}
        given = {name: value for name, value in given.items() if value is not None}
        self.robot = Robot(ros, given.get('enable_stamped_cmd_vel', False))
        self.server = ros.make(ControllerServer, given)
        assert self.server.trigger_configure() is TransitionCallbackReturn.SUCCESS
        assert self.server.trigger_activate() is TransitionCallbackReturn.SUCCESS
        for each in self.server.companions:
            if each.executor is None:
                ros.executor.add_node(each)
        self.client = ActionClient(self.robot.node, FollowPath, 'follow_path')
        self.feedback = []
        ros.wait_until(self.client.server_is_ready, what='follow_path')
        ros.wait_until(lambda: self.server.costmap.is_current, what='the costmap')

    def send(self, points, frame='map', **fields):
        """Send a path of x, y and yaw in the map; return the handle of the goal."""
        goal = FollowPath.Goal(path=make_path([Pose2D(*p) for p in points], frame, Time()))
        for name, value in {'controller_id': 'FollowPath', **fields}.items():
            setattr(goal, name, value)
        future = self.client.send_goal_async(
            goal, feedback_callback=lambda message: self.feedback.append(message.feedback)
        )
        self.ros.wait_until(future.done, what='an answer to the goal')
        return future.result()

    def end(self, handle, timeout_s=20.0):
        """Return the status and the result of a goal."""
        future = handle.get_result_async()
        self.ros.wait_until(future.done, timeout_s, 'the end of the goal')
        return future.result().status, future.result().result

    def run(self, points, **fields):
        return self.end(self.send(points, **fields))

    @property
    def stands(self):
        return bool(self.robot.commands) and self.robot.velocity == (0.0, 0.0)


def line(x, y=0.0, yaw=0.0):
    """Return a straight path from the robot's start, which is at x = 1 m in the map."""
    return [(1.0, 0.0, 0.0), (x, y, yaw)]


@pytest.fixture
def story(ros):
    return Story(ros)


def test_reaches_the_goal(story):
    """A path in the map is followed to its end; then the robot is told to stand."""
    plans = []
    story.robot.node.create_subscription(Path, 'received_global_plan', plans.append, 1)
    story.ros.wait_until(
        lambda: story.server.count_subscribers('received_global_plan'), what='the subscription'
    )
    story.ros.spin(0.1)
    status, result = story.run(line(2.5))
    assert status == GoalStatus.STATUS_SUCCEEDED
    assert (result.error_code, result.error_msg) == (Code.NONE, '')
    assert abs(story.robot.pose.x - 1.5) < 0.3
    story.ros.wait_until(lambda: story.stands, what='a zero velocity')
    assert story.feedback[0].distance_to_goal > story.feedback[-1].distance_to_goal
    assert max(each.speed for each in story.feedback) > 0.5
    assert planar_pose(plans[0].poses[-1].pose).x == 2.5


@pytest.mark.parametrize(
    ('parameters', 'topics'),
    [
        ({}, {'lookahead_point': PointStamped, 'lookahead_collision_arc': Path}),
        (
            {
                'FollowPath.plugin': 'nav2_graceful_controller::GracefulController',
                'FollowPath.transform_tolerance': 1.0,
            },
            {'motion_target': PoseStamped, 'slowdown': Marker, 'local_plan': Path},
        ),
        (
            {'FollowPath.plugin': MPPI, 'FollowPath.visualize': True},
            {'trajectories': MarkerArray, 'local_plan': Path, 'transformed_global_plan': Path},
        ),
        (
            {
                'FollowPath.plugin': 'dwb_core::DWBLocalPlanner',
                'FollowPath.max_vel_x': 0.5,
                'FollowPath.max_speed_xy': 0.5,
                'FollowPath.acc_lim_x': 2.0,
                'FollowPath.decel_lim_x': -2.0,
                'FollowPath.critics': ['BaseObstacle', 'PathDist', 'GoalDist'],
            },
            {'marker': MarkerArray, 'local_plan': Path, 'transformed_global_plan': Path},
        ),
    ],
)
def test_controllers_show_what_they_do(ros, parameters, topics):
    """Each controller publishes its own displays, in the frame of the local costmap."""
    story, seen = Story(ros, parameters), {}
    for topic, kind in topics.items():
        story.robot.node.create_subscription(
            kind, topic, lambda message, topic=topic: seen.setdefault(topic, message), 1
        )
    story.send(line(4.0))
    ros.wait_until(lambda: seen.keys() == topics.keys(), what=f'all of {sorted(topics)}')
    for message in seen.values():
        first = getattr(message, 'markers', [message])[0]
        assert first.header.frame_id == 'odom'


def test_cancel_stops_the_robot_at_once(story):
    """After a cancel there is one more command, which is zero."""
    handle = story.send(line(5.0))
    story.ros.wait_until(lambda: story.robot.velocity[0] > 0.3, what='motion')
    future = handle.cancel_goal_async()
    story.ros.wait_until(future.done, what='the answer to the cancel')
    status, _ = story.end(handle)
    assert status == GoalStatus.STATUS_CANCELED
    story.ros.wait_until(lambda: story.stands, 0.3, 'a zero velocity')
    count = len(story.robot.commands)
    story.ros.spin(0.2)
    assert len(story.robot.commands) == count


def test_newer_path_is_taken_over_without_stopping(story):
    """The first goal is aborted, the second one reached, and no command in between is zero."""
    first = story.send(line(4.5))
    story.ros.wait_until(lambda: story.robot.velocity[0] > 0.5, what='motion')
    before = len(story.robot.commands)
    second = story.send([(1.0, 0.0, 0.0), (2.0, 0.0, 0.0), (3.0, 0.3, 0.0)])
    status, result = story.end(first)
    assert status == GoalStatus.STATUS_ABORTED and result.error_msg
    during = [each.linear.x for each in story.robot.commands[before:]]
    assert min(during) > 0.05
    assert story.end(second)[0] == GoalStatus.STATUS_SUCCEEDED
    assert abs(story.robot.pose.x - 2.0) < 0.3


def test_newer_goal_may_name_another_controller(story):
    """The speed changes to that of the other controller while the robot drives."""
    story.send(line(5.0))
    story.ros.wait_until(lambda: story.robot.velocity[0] > 0.5, what='motion')
    story.send(line(5.0), controller_id='Slow')
    story.ros.wait_until(lambda: 0.0 < story.robot.velocity[0] < 0.25, what='the slow controller')


@pytest.mark.parametrize(
    ('points', 'fields', 'code', 'words'),
    [
        ([], {}, Code.INVALID_PATH, 'empty'),
        ([(1.0, 0.0, 0.0), (float('nan'), 0.0, 0.0)], {}, Code.INVALID_PATH, 'finite'),
        (line(2.0), {'controller_id': 'FolowPath'}, Code.INVALID_CONTROLLER, "mean 'FollowPath'"),
        (line(2.0), {'controller_id': ''}, Code.INVALID_CONTROLLER, 'must name a controller'),
        (line(2.0), {'goal_checker_id': 'chekcer'}, Code.UNKNOWN, 'goal checker'),
        (line(2.0), {'progress_checker_id': 'x'}, Code.UNKNOWN, 'progress checker'),
        (line(2.0), {'frame': 'moon'}, Code.TF_ERROR, 'moon'),
        (line(2.0), {'frame': ''}, Code.TF_ERROR, 'frame_id'),
    ],
)
def test_goal_that_cannot_be_followed_is_aborted(story, points, fields, code, words):
    """Each abort has its code, and a sentence with what is wrong."""
    status, result = story.run(points, **fields)
    assert status == GoalStatus.STATUS_ABORTED
    assert result.error_code == code
    assert words in result.error_msg


def test_robot_that_is_stuck_makes_no_progress(ros):
    """A robot that does not move ends the goal after the time that it has."""
    story = Story(ros, {'progress_checker.movement_time_allowance': 0.6})
    story.robot.is_stuck = True
    status, result = story.run(line(4.0))
    assert status == GoalStatus.STATUS_ABORTED
    assert result.error_code == Code.FAILED_TO_MAKE_PROGRESS
    assert 'did not move' in result.error_msg
    ros.wait_until(lambda: story.stands, 0.3, 'a zero velocity')


def test_wall_on_the_path_leaves_no_valid_control(story):
    """The robot stops before a wall; the message says where it is."""
    story.robot.publish_map(wall_x=2.5)
    status, result = story.run(line(4.0))
    assert status == GoalStatus.STATUS_ABORTED
    assert result.error_code == Code.NO_VALID_CONTROL
    assert 'obstacle' in result.error_msg
    assert story.robot.pose.x < 1.3


def test_patience_is_exceeded_after_the_tolerance(ros):
    """With a tolerance the robot stands before the wall for a while first."""
    story = Story(ros, {'failure_tolerance': 0.5})
    story.robot.publish_map(wall_x=2.5)
    status, result = story.run(line(4.0))
    assert status == GoalStatus.STATUS_ABORTED
    assert result.error_code == Code.PATIENCE_EXCEEDED
    assert 'no valid velocity' in result.error_msg


def test_speed_limit_holds_and_ends(story):
    """Limits in percent and in m/s slow the robot down while it drives; 0 ends them."""
    limits = story.robot.node.create_publisher(SpeedLimit, 'speed_limit', 1)
    story.ros.wait_until(limits.get_subscription_count, what='the server on speed_limit')
    limits.publish(SpeedLimit(percentage=True, speed_limit=20.0))
    story.ros.spin(0.1)
    story.send(line(6.0))

    def speed_is(low, high):
        return lambda: low < story.robot.velocity[0] < high

    story.ros.wait_until(speed_is(0.28, 0.32), what='20 %')
    limits.publish(SpeedLimit(percentage=False, speed_limit=0.1))
    story.ros.wait_until(speed_is(0.08, 0.12), what='0.1 m/s')
    limits.publish(SpeedLimit(speed_limit=0.0))
    story.ros.wait_until(speed_is(0.5, 2.0), what='full speed')


def test_lost_robot_stops_and_the_goal_ends(story):
    """Without odometry and tf the robot is told to stand within a second."""
    handle = story.send(line(6.0))
    story.ros.wait_until(lambda: story.robot.velocity[0] > 0.5, what='motion')
    story.robot.has_tf = False
    story.ros.wait_until(lambda: story.stands, 1.0, 'a zero velocity')
    status, result = story.end(handle)
    assert status == GoalStatus.STATUS_ABORTED
    assert result.error_code == Code.TF_ERROR
    assert 's old' in result.error_msg


def test_stamped_commands(ros):
    """With enable_stamped_cmd_vel, commands have a header in the frame of the robot."""
    story = Story(ros, {'enable_stamped_cmd_vel': True})
    story.send(line(3.0))
    ros.wait_until(lambda: story.robot.velocity[0] > 0.3, what='motion')
    assert story.robot.commands[-1].header.frame_id == 'base_link'


def test_deactivation_stops_the_robot(story):
    """A server that is deactivated stops the robot and ends its goal; it may be active again."""
    handle = story.send(line(6.0))
    story.ros.wait_until(lambda: story.robot.velocity[0] > 0.5, what='motion')
    story.server.trigger_deactivate()
    story.ros.wait_until(lambda: story.stands, 0.3, 'a zero velocity')
    status, result = story.end(handle)
    assert status == GoalStatus.STATUS_ABORTED and 'deactivated' in result.error_msg
    assert story.server.trigger_activate() is TransitionCallbackReturn.SUCCESS
    assert story.run(line(3.0))[0] == GoalStatus.STATUS_SUCCEEDED


@pytest.mark.parametrize(
    ('parameters', 'words'),
    [
        ({'FollowPath.plugin': 'dwb_core::DWBLocalPlaner'}, "mean 'dwb_core::DWBLocalPlanner'"),
        ({'FollowPath.plugin': 'dwb_core::DWBLocalPlanner'}, 'cannot move'),
        ({'controller_plugins': ['A'], 'A.plugin': ''}, "'A.plugin' is not set"),
        ({'FollowPath.desired_linear_vel': 'fast'}, 'FollowPath.desired_linear_vel'),
        ({'FollowPath.allow_reversing': True}, 'exclude each other'),
    ],
)
def test_wrong_parameters_are_explained(ros, capfd, parameters, words):
    """A server that cannot be configured says which parameter is wrong."""
    server = ros.make(ControllerServer, {**PARAMETERS, **parameters})
    assert server.trigger_configure() is not TransitionCallbackReturn.SUCCESS
    assert words in capfd.readouterr().err


def test_older_names_of_checkers(ros):
    """The singular names of older parameter files name the checkers, too."""
    server = ros.make(
        ControllerServer,
        {
            **PARAMETERS,
            'progress_checker_plugin': 'old_progress',
            'old_progress.plugin': 'nav2_controller::PoseProgressChecker',
            'goal_checker_plugin': 'old_goal',
            'old_goal.plugin': 'nav2_controller::StoppedGoalChecker',
        },
    )
    assert server.trigger_configure() is TransitionCallbackReturn.SUCCESS
    assert list(server.progress_checkers) == ['old_progress']
    assert list(server.goal_checkers) == ['old_goal']


def test_server_may_be_cleaned_up_and_configured_again(story):
    """After all transitions in the middle of a goal the server follows paths again."""
    handle = story.send(line(6.0))
    story.ros.wait_until(lambda: story.robot.velocity[0] > 0.5, what='motion')
    story.server.trigger_deactivate()
    story.server.trigger_cleanup()
    assert story.server.trigger_configure() is TransitionCallbackReturn.SUCCESS
    assert story.server.trigger_activate() is TransitionCallbackReturn.SUCCESS
    story.ros.wait_until(lambda: story.server.costmap.is_current, what='the costmap')
    assert 'deactivated' in story.end(handle)[1].error_msg
    assert story.run(line(3.0))[0] == GoalStatus.STATUS_SUCCEEDED


def flat(values, prefix=''):
    """Return nested parameters by their full names."""
    found = {}
    for name, value in values.items():
        if isinstance(value, dict):
            found.update(flat(value, f'{prefix}{name}.'))
        else:
            found[f'{prefix}{name}'] = value
    return found


MPPI_FILE = {
    'controller_frequency': 20.0,
    'costmap_update_timeout': 0.30,
    'min_x_velocity_threshold': 0.001,
    'min_y_velocity_threshold': 0.5,
    'min_theta_velocity_threshold': 0.001,
    'failure_tolerance': 0.3,
    'progress_checker_plugins': ['progress_checker'],
    'goal_checker_plugins': ['general_goal_checker'],
    'controller_plugins': ['FollowPath'],
    'use_realtime_priority': False,
    'progress_checker': {
        'plugin': 'nav2_controller::SimpleProgressChecker',
        'required_movement_radius': 0.5,
        'movement_time_allowance': 10.0,
    },
    'general_goal_checker': {
        'stateful': True,
        'plugin': 'nav2_controller::SimpleGoalChecker',
        'xy_goal_tolerance': 0.25,
        'yaw_goal_tolerance': 0.25,
    },
    'FollowPath': {
        'plugin': MPPI,
        'time_steps': 56,
        'model_dt': 0.05,
        'batch_size': 2000,
        'ax_max': 3.0,
        'ax_min': -3.0,
        'ay_max': 3.0,
        'ay_min': -3.0,
        'az_max': 3.5,
        'vx_std': 0.2,
        'vy_std': 0.2,
        'wz_std': 0.4,
        'vx_max': 0.5,
        'vx_min': -0.35,
        'vy_max': 0.5,
        'wz_max': 1.9,
        'iteration_count': 1,
        'prune_distance': 1.7,
        'transform_tolerance': 0.1,
        'temperature': 0.3,
        'gamma': 0.015,
        'motion_model': 'DiffDrive',
        'visualize': True,
        'regenerate_noises': True,
        'TrajectoryVisualizer': {'trajectory_step': 5, 'time_step': 3},
        'AckermannConstraints': {'min_turning_r': 0.2},
        'critics': [
            'ConstraintCritic',
            'CostCritic',
            'GoalCritic',
            'GoalAngleCritic',
            'PathAlignCritic',
            'PathFollowCritic',
            'PathAngleCritic',
            'PreferForwardCritic',
        ],
        'ConstraintCritic': {'enabled': True, 'cost_power': 1, 'cost_weight': 4.0},
        'GoalCritic': {'enabled': True, 'cost_weight': 5.0, 'threshold_to_consider': 1.4},
        'CostCritic': {
            'enabled': True,
            'cost_power': 1,
            'cost_weight': 3.81,
            'near_collision_cost': 253,
            'critical_cost': 300.0,
            'consider_footprint': False,
            'collision_cost': 1000000.0,
            'near_goal_distance': 1.0,
            'trajectory_point_step': 2,
        },
        'PathAlignCritic': {
            'enabled': True,
            'max_path_occupancy_ratio': 0.05,
            'use_path_orientations': False,
        },
    },
}


def test_usual_parameter_file_needs_no_word(ros, capfd):
    """Parameters as in the usual file for MPPI are all known, and work."""
    local = {k: v for k, v in PARAMETERS.items() if k.startswith('local_costmap')}
    patience = {'costmap_update_timeout': 30.0}  # of a machine busy with other tests
    story = Story(ros, {**dict.fromkeys(PARAMETERS), **flat(MPPI_FILE), **local, **patience})
    handle = story.send(line(3.0))
    ros.wait_until(lambda: story.robot.velocity[0] > 0.2, what='motion')
    handle.cancel_goal_async()
    said = capfd.readouterr().err
    assert 'no effect' not in said
    assert 'There is no parameter' not in said
