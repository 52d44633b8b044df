# SPDX-License-Identifier: Apache-2.0
"""The behaviours: each to its end, out of time, canceled, replaced, refused and lost."""

from __future__ import annotations

import math
import time

from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Duration
from geometry_msgs.msg import Point, Point32, PolygonStamped, TransformStamped, Twist
from nav2_behaviors import BehaviorServer
from nav2_behaviors.motion import drive_speed, motion_ahead, Turn, turn_rate
from nav2_behaviors.timed_behavior import seconds
from nav2_msgs.action import AssistedTeleop, BackUp, DriveOnHeading, Spin, Wait
from nav2_msgs.msg import Costmap, CostmapUpdate
from nav2_util.geometry import make_quaternion, Pose2D
from nav2_util.twist import Velocity
import numpy as np
import pytest
from rclpy.action import ActionClient
from rclpy.lifecycle import TransitionCallbackReturn
from rclpy.qos import DurabilityPolicy, QoSProfile
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Empty
from tf2_ros import TransformBroadcaster

QUICK = {'cycle_frequency': 20.0}
STEP_S = 0.02


class TestMotion:
    def test_turn_counts_beyond_half_a_turn(self):
        """Turning goes on through pi, and back turns count against it."""
        turn = Turn(-4.0, 3.0)
        for yaw in (2.0, 1.0, 0.0, -1.0, -0.9):
            turn.update(yaw)
        assert turn.turned_rad == pytest.approx(-3.9)
        assert turn.remaining_rad == pytest.approx(0.1)
        turn.update(-1.1)
        assert turn.is_done

    def test_rate_falls_near_the_end(self):
        """The rate is limited above and below, and lets the robot stop in between."""
        assert turn_rate(10.0, 1.0, 0.4, 3.2) == 1.0
        assert turn_rate(0.1, 1.0, 0.4, 3.2) == pytest.approx(0.8)
        assert turn_rate(0.001, 1.0, 0.4, 3.2) == 0.4

    def test_speed_grows_and_falls(self):
        """The speed keeps to its limits, but not below what moves the robot."""
        limits = {'acceleration': 1.0, 'deceleration': 2.0, 'minimum_speed': 0.05, 'period_s': 0.1}
        assert drive_speed(0.5, 0.0, 1.0, **limits) == pytest.approx(0.1)
        assert drive_speed(-0.5, 0.5, 1.0, **limits) == pytest.approx(0.5)
        assert drive_speed(0.5, 0.5, 0.01, **limits) == pytest.approx(0.2)
        assert drive_speed(0.5, 0.1, 1e-6, **limits) == pytest.approx(0.05)
        assert drive_speed(0.02, 0.0, 1e-6, **limits) == pytest.approx(0.02)
        limits.update(acceleration=0.0, deceleration=0.0)
        assert drive_speed(0.5, 0.0, 1e-6, **limits) == pytest.approx(0.5)

    def test_motion_ahead_ends_at_the_target(self):
        """The look ahead ends where the motion ends."""
        times, poses = motion_ahead(Velocity(x=0.5), 2.0, 0.1, 0.25)
        assert times == pytest.approx([0.1, 0.2, 0.25])
        assert poses[-1] == pytest.approx([0.125, 0.0, 0.0])
        _, poses = motion_ahead(Velocity(x=1.0, yaw=math.pi), 1.0, 0.01)
        assert poses[-1] == pytest.approx([0.0, 2.0 / math.pi, math.pi], abs=1e-9)


class World:
    """A robot that drives as told, its odometry, a costmap and a footprint."""

    def __init__(self, ros, parameters=None, costmap=True):
        self.ros, self.pose, self.velocity = ros, Pose2D(1.0, 2.0, 0.3), Velocity()
        self.speeds, self.slip, self.has_odometry = [], 1.0, True
        self.node = ros.make(BehaviorServer, {**QUICK, **(parameters or {})})
        self.tester = ros.node()
        self.clients = {}
        self.broadcaster = TransformBroadcaster(self.tester)
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.costmaps = self.tester.create_publisher(Costmap, 'local_costmap/costmap_raw', latched)
        self.updates = self.tester.create_publisher(
            CostmapUpdate, 'local_costmap/costmap_raw_updates', 1
        )
        self.teleop = self.tester.create_publisher(Twist, 'cmd_vel_teleop', 1)
        self.over = self.tester.create_publisher(Empty, 'preempt_teleop', 1)
        self.footprints = self.tester.create_publisher(
            PolygonStamped, 'local_costmap/published_footprint', 1
        )
        self.tester.create_subscription(Twist, 'cmd_vel', self._on_velocity, 50)
        self.tester.create_timer(STEP_S, self._step)
        self.cells = np.zeros((100, 100), np.uint8)
        if costmap:
            self.publish_costmap()
        assert self.node.trigger_configure() == TransitionCallbackReturn.SUCCESS
        assert self.node.trigger_activate() == TransitionCallbackReturn.SUCCESS
        checker = self.node.local_checker
        ros.wait_until(
            lambda: (
                checker._footprint_message is not None
                and (checker._costmap is not None) is costmap
                and self.node.transforms.buffer.can_transform_core('odom', 'base_link', _LATEST)[0]
                and self.tester.count_subscribers('cmd_vel')
                and self.node.count_subscribers('cmd_vel')
            ),
            what='the world',
        )

    def publish_costmap(self):
        """Publish the 5 m x 5 m costmap around the robot."""
        message = Costmap()
        message.header.frame_id = 'odom'
        meta = message.metadata
        meta.resolution, meta.size_x, meta.size_y = 0.05, 100, 100
        meta.origin.position.x, meta.origin.position.y = -1.5, -0.5
        message.data = self.cells.ravel().tolist()
        self.costmaps.publish(message)

    def wall(self, distance, cost=254):
        """Put a wall across the heading of the robot; behind it if the distance is negative."""
        x, y = np.meshgrid(np.arange(100) * 0.05 - 1.475, np.arange(100) * 0.05 - 0.475)
        ahead = (x - 1.0) * math.cos(0.3) + (y - 2.0) * math.sin(0.3)
        self.cells[np.abs(ahead - distance) < 0.06] = cost
        self.publish_costmap()

    def _on_velocity(self, message):
        self.velocity = Velocity(message.linear.x, message.linear.y, message.angular.z)
        self.speeds.append(self.velocity)

    def _step(self):
        self.pose = self.pose @ Pose2D(
            *self.velocity.scaled(self.slip).poses_after(np.array([STEP_S]))[0]
        )
        stamp = self.tester.get_clock().now().to_msg()
        if self.has_odometry:
            moved = TransformStamped()
            moved.header.frame_id, moved.child_frame_id = 'odom', 'base_link'
            moved.header.stamp = stamp
            moved.transform.translation.x, moved.transform.translation.y = self.pose[:2]
            moved.transform.rotation = make_quaternion(self.pose.yaw)
            self.broadcaster.sendTransform(moved)
        footprint = PolygonStamped()
        footprint.header.frame_id, footprint.header.stamp = 'odom', stamp
        corners = [(0.2, 0.15), (0.2, -0.15), (-0.2, -0.15), (-0.2, 0.15)]
        places = [self.pose @ Pose2D(*each, 0.0) for each in corners]
        footprint.polygon.points = [Point32(x=each.x, y=each.y) for each in places]
        self.footprints.publish(footprint)

    def send(self, kind, name, goal, feedback=None):
        """Send a goal; return its handle."""
        if name not in self.clients:
            self.clients[name] = ActionClient(self.tester, kind, name)
        client = self.clients[name]
        self.ros.wait_until(client.server_is_ready, what=name)
        future = client.send_goal_async(goal, feedback and (lambda m: feedback.append(m.feedback)))
        self.ros.wait_until(future.done, what='the acceptance')
        assert future.result().accepted
        return future.result()

    def result(self, handle, timeout_s=20.0):
        """Wait for the end of a goal; return its status and result."""
        future = handle.get_result_async()
        self.ros.wait_until(future.done, timeout_s, 'the result')
        return future.result().status, future.result().result

    def run(self, kind, name, goal, feedback=None):
        """Send a goal and wait for its end; the robot rests then."""
        found = self.result(self.send(kind, name, goal, feedback))
        self.ros.wait_until(lambda: self.velocity.is_zero, 2.0, 'rest')
        return found

    def moves(self):
        """Wait until the robot is told to move."""
        self.ros.wait_until(lambda: not self.velocity.is_zero, what='motion')


def _latest():
    from rclpy.time import Time

    return Time()


_LATEST = _latest()


def span(seconds):
    return Duration(sec=int(seconds), nanosec=int(seconds % 1 * 1e9))


def spin(yaw, allowance=10.0):
    return Spin.Goal(target_yaw=yaw, time_allowance=span(allowance))


def drive(x, speed, allowance=10.0, y=0.0, kind=DriveOnHeading):
    return kind.Goal(target=Point(x=x, y=y), speed=speed, time_allowance=span(allowance))


def back(x, speed, allowance=10.0):
    return drive(x, speed, allowance, kind=BackUp)


class TestEnds:
    def test_spin(self, ros):
        """The robot turns by the angle, with feedback, and slower near the end."""
        world, feedback = World(ros), [None]
        start = time.monotonic()
        status, result = world.run(Spin, 'spin', spin(-1.0), feedback)
        took = time.monotonic() - start
        assert status == GoalStatus.STATUS_SUCCEEDED and result.error_code == Spin.Result.NONE
        assert world.pose.yaw == pytest.approx(0.3 - 1.0, abs=0.15)
        assert feedback[-1].angular_distance_traveled == pytest.approx(-1.0, abs=0.1)
        rates = [each.yaw for each in world.speeds if not each.is_zero]
        assert min(rates) == -1.0 and max(rates) == pytest.approx(-0.4, abs=0.3)
        assert 0.8 < seconds(result.total_elapsed_time) <= took

    def test_drive_on_heading(self, ros):
        """The robot drives the distance along its heading."""
        world, feedback = World(ros), [None]
        goal = drive(0.3, 0.4)
        status, result = world.run(DriveOnHeading, 'drive_on_heading', goal, feedback)
        assert status == GoalStatus.STATUS_SUCCEEDED, result.error_msg
        driven = Pose2D(1.0, 2.0, 0.3).inverse() @ world.pose
        assert driven == pytest.approx((0.3, 0.0, 0.0), abs=0.05)
        assert feedback[-1].distance_traveled == pytest.approx(0.3, abs=0.05)
        assert world.speeds[0].x == pytest.approx(2.5 / 20)

    def test_backup(self, ros):
        """The robot drives back, whatever the signs of the goal are."""
        world = World(ros)
        status, result = world.run(BackUp, 'backup', back(0.2, 0.3))
        assert status == GoalStatus.STATUS_SUCCEEDED, result.error_msg
        driven = Pose2D(1.0, 2.0, 0.3).inverse() @ world.pose
        assert driven == pytest.approx((-0.2, 0.0, 0.0), abs=0.05)

    def test_wait(self, ros):
        """Waiting lasts as long as it is told to, with the time left as feedback."""
        world, feedback = World(ros, costmap=False), [None]
        start = time.monotonic()
        status, result = world.run(Wait, 'wait', Wait.Goal(time=span(0.4)), feedback)
        took = time.monotonic() - start
        assert status == GoalStatus.STATUS_SUCCEEDED
        assert 0.4 <= seconds(result.total_elapsed_time) <= took
        left = [seconds(each.time_left) for each in feedback[1:]]
        assert left == sorted(left, reverse=True)
        assert left[0] <= 0.4 and left[-1] == 0.0

    def test_assisted_teleop(self, ros):
        """A person drives; a message ends it well."""
        world, feedback = World(ros), [None]
        goal = AssistedTeleop.Goal(time_allowance=span(10.0))
        handle = world.send(AssistedTeleop, 'assisted_teleop', goal, feedback)
        twist = Twist()
        twist.linear.x = 0.2
        world.teleop.publish(twist)
        ros.wait_until(lambda: world.velocity.x == pytest.approx(0.2), what='motion')
        world.over.publish(Empty())
        assert world.result(handle)[0] == GoalStatus.STATUS_SUCCEEDED
        ros.wait_until(lambda: world.velocity.is_zero, what='rest')
        assert feedback[-1].current_teleop_duration.nanosec > 0

    def test_teleop_slows_down_before_a_wall(self, ros):
        """The speed falls the nearer a wall is, and the robot never touches it."""
        world = World(ros)
        world.wall(0.7)
        goal = AssistedTeleop.Goal(time_allowance=span(3.0))
        handle = world.send(AssistedTeleop, 'assisted_teleop', goal)
        twist = Twist()
        twist.linear.x = 0.4
        world.teleop.publish(twist)
        status, result = world.result(handle)
        assert status == GoalStatus.STATUS_ABORTED
        assert (
            result.error_code == AssistedTeleop.Result.TIMEOUT and 'allowance' in result.error_msg
        )
        driven = Pose2D(1.0, 2.0, 0.3).inverse() @ world.pose
        assert 0.2 < driven.x < 0.5
        speeds = [each.x for each in world.speeds]
        assert any(0.0 < each < 0.3 for each in speeds)


class TestRefusals:
    def test_collision_ahead(self, ros):
        """With a wall ahead the robot does not drive into it; with the way free again it does."""
        world = World(ros)
        world.wall(0.45)
        goal = drive(0.5, 0.3)
        status, result = world.run(DriveOnHeading, 'drive_on_heading', goal)
        assert status == GoalStatus.STATUS_ABORTED
        assert result.error_code == DriveOnHeading.Result.COLLISION_AHEAD
        assert 'collision' in result.error_msg
        driven = Pose2D(1.0, 2.0, 0.3).inverse() @ world.pose
        assert driven.x < 0.25
        cleared = CostmapUpdate(size_x=100, size_y=100, data=[0] * 10000)
        world.updates.publish(cleared)
        ros.spin(0.2)
        status, result = world.run(DriveOnHeading, 'drive_on_heading', goal)
        assert status == GoalStatus.STATUS_SUCCEEDED, result.error_msg

    def test_unknown_is_no_obstacle(self, ros):
        """The robot backs up into what is unknown, and spins there, but not into a wall."""
        world = World(ros)
        world.wall(-0.4, cost=255)
        status, result = world.run(BackUp, 'backup', back(-0.3, 0.3))
        assert status == GoalStatus.STATUS_SUCCEEDED, result.error_msg
        world.wall(-0.6)
        status, result = world.run(BackUp, 'backup', back(-0.3, 0.3))
        assert result.error_code == BackUp.Result.COLLISION_AHEAD

    def test_spin_beside_an_obstacle(self, ros):
        """A corner of the robot would touch: the turn is refused."""
        world = World(ros)
        world.wall(0.24)
        _status, result = world.run(Spin, 'spin', spin(1.5))
        assert result.error_code == Spin.Result.COLLISION_AHEAD and result.error_msg

    @pytest.mark.parametrize(
        'goal',
        [
            drive(0.3, -0.1),
            drive(-0.3, 0.1),
            drive(0.3, 0.0),
            drive(0.3, 0.1, y=0.1),
            drive(math.nan, 0.1),
            drive(0.3, math.inf),
        ],
    )
    def test_invalid_input(self, ros, goal):
        """Signs that disagree, sideways targets and numbers that are none are refused."""
        world = World(ros)
        status, result = world.run(DriveOnHeading, 'drive_on_heading', goal)
        assert status == GoalStatus.STATUS_ABORTED
        assert result.error_code == DriveOnHeading.Result.INVALID_INPUT and result.error_msg
        assert all(each.is_zero for each in world.speeds)

    def test_backup_sideways_and_spin_by_nothing(self, ros):
        """A sideways backup is refused; a turn by a number that is none, too."""
        world = World(ros)
        goal = drive(-0.3, 0.1, y=0.2, kind=BackUp)
        assert world.run(BackUp, 'backup', goal)[1].error_code == BackUp.Result.INVALID_INPUT
        result = world.run(Spin, 'spin', spin(math.nan))[1]
        assert result.error_code == Spin.Result.UNKNOWN and 'nan' in result.error_msg

    def test_timeout(self, ros):
        """A robot that is stuck gives up after its time allowance."""
        world = World(ros)
        world.slip = 0.0
        status, result = world.run(BackUp, 'backup', back(0.5, 0.1, 0.4))
        assert status == GoalStatus.STATUS_ABORTED
        assert result.error_code == BackUp.Result.TIMEOUT and '0.4 s' in result.error_msg

    def test_no_costmap(self, ros):
        """Without a costmap nothing moves, and the message names the topic."""
        world = World(ros, costmap=False)
        _status, result = world.run(Spin, 'spin', spin(1.0))
        assert result.error_code == Spin.Result.COLLISION_AHEAD
        assert 'local_costmap/costmap_raw' in result.error_msg
        assert all(each.is_zero for each in world.speeds)

    def test_lost_transforms(self, ros):
        """When the odometry stops, the behaviour stops the robot and says so."""
        world = World(ros)
        handle = world.send(Spin, 'spin', spin(60.0, 60.0))
        world.moves()
        world.has_odometry = False
        status, result = world.result(handle)
        assert status == GoalStatus.STATUS_ABORTED
        assert result.error_code == Spin.Result.TF_ERROR and 'base_link' in result.error_msg
        ros.wait_until(lambda: world.velocity.is_zero, what='rest')

    def test_pose_was_never_known(self, ros):
        """A frame that nobody publishes is an error of transforms."""
        world = World(ros, {'local_frame': 'nowhere'})
        result = world.run(BackUp, 'backup', back(0.3, 0.1))[1]
        assert result.error_code == BackUp.Result.TF_ERROR and 'nowhere' in result.error_msg


class TestInterruptions:
    def test_cancel_stops_at_once(self, ros):
        """A goal that is canceled ends with zero velocity before its cycle of 10 s is over."""
        world, feedback = World(ros, {'cycle_frequency': 0.1}), [None]
        handle = world.send(Spin, 'spin', spin(30.0, 60.0), feedback)
        world.moves()
        handle.cancel_goal_async()
        assert world.result(handle)[0] == GoalStatus.STATUS_CANCELED
        ros.wait_until(lambda: world.velocity.is_zero, what='rest')
        assert len(feedback) == 2  # one a cycle

    def test_newer_goal_takes_over(self, ros):
        """A newer goal ends the older one and is reached."""
        world = World(ros)
        first = world.send(Spin, 'spin', spin(30.0, 60.0))
        world.moves()
        second = world.send(Spin, 'spin', spin(-0.2))
        status, result = world.result(first)
        assert status == GoalStatus.STATUS_ABORTED and 'newer' in result.error_msg
        assert world.result(second)[0] == GoalStatus.STATUS_SUCCEEDED

    def test_deactivation_stops_the_robot(self, ros):
        """The node is deactivated in motion: zero velocity, goal aborted, new ones rejected."""
        world = World(ros)
        handle = world.send(Spin, 'spin', spin(30.0, 60.0))
        world.moves()
        world.node.trigger_deactivate()
        ros.wait_until(lambda: world.velocity.is_zero, what='rest')
        assert world.result(handle)[0] == GoalStatus.STATUS_ABORTED
        count = len(world.speeds)
        ros.spin(0.2)
        assert len(world.speeds) == count
        assert world.node.trigger_activate() == TransitionCallbackReturn.SUCCESS
        assert world.run(Spin, 'spin', spin(0.1))[0] == GoalStatus.STATUS_SUCCEEDED

    def test_cleaned_up_in_motion(self, ros):
        """A node that is deactivated and cleaned up at once ends its goal, and can begin anew."""
        world = World(ros)
        handle = world.send(Spin, 'spin', spin(30.0, 60.0))
        world.moves()
        node = world.node
        for step in (node.trigger_deactivate, node.trigger_cleanup, node.trigger_configure):
            assert step() == TransitionCallbackReturn.SUCCESS
        ros.wait_until(lambda: world.velocity.is_zero, what='rest')
        assert world.result(handle, 5.0)[0] == GoalStatus.STATUS_ABORTED
        assert node.trigger_activate() == TransitionCallbackReturn.SUCCESS
        ros.wait_until(lambda: node.local_checker._footprint_message, what='a footprint')
        ros.wait_until(lambda: node.local_checker._costmap, what='a costmap')
        status, result = world.run(Spin, 'spin', spin(0.2))
        assert status == GoalStatus.STATUS_SUCCEEDED, result.error_msg


class TestSimulatedTime:
    def test_waiting_by_the_clock_of_a_simulator(self, ros):
        """A minute of a fast simulator passes in a moment; a simulator at rest holds it up."""
        world = World(ros, costmap=False)
        simulator = ros.node('simulator')
        clock = simulator.create_publisher(Clock, 'clock', 1)
        parameters = {
            'use_sim_time': True,
            'behavior_plugins': ['pause'],
            'pause.plugin': 'nav2_behaviors::Wait',
        }
        node = ros.make(BehaviorServer, parameters, node_name='simulated')
        assert node.trigger_configure() == TransitionCallbackReturn.SUCCESS
        assert node.trigger_activate() == TransitionCallbackReturn.SUCCESS
        message, is_running = Clock(), [True]

        def tick():
            message.clock.sec += is_running[0]
            clock.publish(message)

        simulator.create_timer(0.02, tick)
        ros.wait_until(lambda: node.get_clock().now().nanoseconds, what='simulated time')
        handle = world.send(Wait, 'pause', Wait.Goal(time=span(60.0)))
        ros.spin(0.2)
        is_running[0] = False
        future = handle.get_result_async()
        ros.spin(0.5)
        assert not future.done()
        is_running[0] = True
        ros.wait_until(future.done, 10.0, 'the end')
        assert future.result().result.total_elapsed_time.sec >= 60


class TestConfiguration:
    def test_types_with_a_slash_and_other_names(self, ros):
        """Behaviours may have names of their own, and types with a slash."""
        parameters = {
            'behavior_plugins': ['rest', 'spin'],
            'rest.plugin': 'nav2_behaviors/Wait',
            'spin.plugin': 'nav2_behaviors/Spin',
        }
        world = World(ros, parameters, costmap=False)
        status, _ = world.run(Wait, 'rest', Wait.Goal(time=span(0.1)))
        assert status == GoalStatus.STATUS_SUCCEEDED

    @pytest.mark.parametrize(
        'parameters',
        [
            {'behavior_plugins': ['dance']},
            {'behavior_plugins': ['spin'], 'spin.plugin': 'nav2_behaviors::Spni'},
            {'behavior_plugins': ['spin', 'spin']},
            {'cycle_frequency': 0.0},
            {'backup.deceleration_limit': 1.0},
        ],
    )
    def test_wrong_parameters(self, ros, parameters):
        """A server with wrong parameters is not configured."""
        node = ros.make(BehaviorServer, parameters)
        assert node.trigger_configure() == TransitionCallbackReturn.FAILURE


class TestAttacks:
    """Goals and costmaps that nobody should send."""

    def test_huge_goals(self, ros):
        """A way without end lasts as long as its time allowance."""
        world = World(ros)
        world.slip = 0.0
        for kind, name, goal in (
            (DriveOnHeading, 'drive_on_heading', drive(1e300, 0.3, 0.3)),
            (BackUp, 'backup', back(1e300, 0.3, 0.3)),
            (Spin, 'spin', spin(1e30, 0.3)),
        ):
            _, result = world.run(kind, name, goal)
            assert result.error_code == kind.Result.TIMEOUT, result.error_msg
        _, result = world.run(DriveOnHeading, 'drive_on_heading', drive(1.0, 1e30, 0.3))
        assert result.error_code in (
            DriveOnHeading.Result.COLLISION_AHEAD,
            DriveOnHeading.Result.TIMEOUT,
        )

    def test_nothing_to_do(self, ros):
        """Goals that are reached at once succeed, and nothing moves."""
        world = World(ros)
        for kind, name, goal in (
            (Spin, 'spin', spin(0.0)),
            (BackUp, 'backup', back(0.0, 0.0)),
            (DriveOnHeading, 'drive_on_heading', drive(0.0, 0.0)),
            (Wait, 'wait', Wait.Goal(time=Duration(sec=-5))),
        ):
            status, result = world.run(kind, name, goal)
            assert status == GoalStatus.STATUS_SUCCEEDED, result.error_msg
        assert all(each.is_zero for each in world.speeds)

    def test_malformed_costmaps(self, ros):
        """A costmap of the wrong size is none; updates that do not fit are ignored."""
        world = World(ros)
        for x, y, width, height, data in (
            (90, 0, 20, 1, [254] * 20),
            (0, 0, 5, 5, [254]),
            (2**32 - 1, 0, 1, 1, [254]),
            (0, 0, 0, 0, []),
        ):
            world.updates.publish(CostmapUpdate(x=x, y=y, size_x=width, size_y=height, data=data))
            ros.spin(0.05)
        status, result = world.run(Spin, 'spin', spin(0.2))
        assert status == GoalStatus.STATUS_SUCCEEDED, result.error_msg
        for size, resolution in ((7, 0.05), (100, 0.0), (0, 0.05), (100, math.nan)):
            message = Costmap(data=[0] * 10_000)
            message.header.frame_id = 'odom'
            message.metadata.size_x = message.metadata.size_y = size
            message.metadata.resolution = resolution
            world.costmaps.publish(message)
            ros.spin(0.05)
            _, result = world.run(Spin, 'spin', spin(0.2))
            assert result.error_code == Spin.Result.COLLISION_AHEAD
            assert 'malformed' in result.error_msg
        world.publish_costmap()
        ros.spin(0.05)
        assert world.run(Spin, 'spin', spin(0.2))[0] == GoalStatus.STATUS_SUCCEEDED

    def test_teleop_velocities_that_are_not_finite(self, ros):
        """A velocity that is not a number is not passed on."""
        world = World(ros)
        goal = AssistedTeleop.Goal(time_allowance=span(0.5))
        handle = world.send(AssistedTeleop, 'assisted_teleop', goal)
        for value in (math.nan, math.inf, 1e300):
            twist = Twist()
            twist.linear.x = value
            world.teleop.publish(twist)
        assert world.result(handle)[1].error_code == AssistedTeleop.Result.TIMEOUT
        assert all(each.is_zero for each in world.speeds)
