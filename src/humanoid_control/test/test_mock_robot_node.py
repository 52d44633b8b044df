# SPDX-License-Identifier: Apache-2.0
"""Check the mock robot in this process: its topics, and who moves its joints."""

from __future__ import annotations

from collections.abc import Iterator
import math
from typing import Any

from builtin_interfaces.msg import Duration
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PointStamped, Twist
from humanoid_common.qos import LATCHED, SENSOR
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_control.mock_robot import MockRobot
from nav_msgs.msg import Odometry
import pytest
from rcl_interfaces.msg import Log
from rclpy.parameter import Parameter
from rclpy.publisher import Publisher
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import Bool, String
from tf2_msgs.msg import TFMessage
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint
from visualization_msgs.msg import MarkerArray


class Watch:
    """A mock robot, and what it says."""

    def __init__(self, ros: RosSandbox) -> None:
        """Prepare to listen."""
        self.ros = ros
        self.node = ros.observer()
        self.last: dict[str, Any] = {}
        self.logs: list[str] = []
        self.node.create_subscription(Log, '/rosout', lambda log: self.logs.append(log.msg), 100)
        self.listen(JointState, 'joint_states')

    def listen(self, kind: type, topic: str, qos: Any = 10) -> None:
        """Keep the newest message of a topic."""
        self.node.create_subscription(
            kind, topic, lambda message: self.last.__setitem__(topic, message), qos
        )

    def start(self, **parameters: Any) -> MockRobot:
        """Start the robot, and wait for its joints."""
        robot = self.ros.start(MockRobot, parameters)
        self.wait_for('joint_states')
        return robot

    def wait_for(self, *topics: str) -> None:
        """Wait for a message on each of the topics."""
        self.ros.wait_until(lambda: set(topics) <= set(self.last), 60.0, f'all of {topics}')

    def publisher(self, kind: type, topic: str, qos: Any = 10) -> Publisher:
        """Return a publisher that the robot has found."""
        publisher = self.node.create_publisher(kind, topic, qos)
        self.ros.wait_until(lambda: publisher.get_subscription_count() >= 1, what=topic)
        return publisher

    def joint_rad(self, joint: str, topic: str = 'joint_states') -> float:
        """Return where a joint is."""
        states = self.last[topic]
        return float(states.position[list(states.name).index(joint)])

    def keep_on(self, publisher: Publisher, message: Any, until: Any, what: str) -> None:
        """Publish again and again until something comes true."""

        def publish_and_look() -> bool:
            publisher.publish(message)
            return bool(until())

        self.ros.wait_until(publish_and_look, 100.0, what)

    def told(self, words: str) -> int:
        """Return how often the log has some words."""
        return sum(words in line for line in self.logs)


@pytest.fixture(name='watch')
def _watch() -> Iterator[Watch]:
    """Give a domain of its own."""
    with ros_sandbox() as sandbox:
        yield Watch(sandbox)


def test_sensors(watch: Watch) -> None:
    """All joints are told with their names; the inertial sensor is level; the base stands."""
    for kind, topic, qos in (
        (Imu, 'imu/data', SENSOR),
        (Odometry, 'odom', 10),
        (TFMessage, 'tf', 10),
        (String, 'walking_state', LATCHED),
        (DiagnosticArray, 'diagnostics', 10),
    ):
        watch.listen(kind, topic, qos)
    watch.start()
    watch.wait_for('imu/data', 'odom', 'tf', 'walking_state', 'diagnostics')
    joints, imu, odom = (watch.last[topic] for topic in ('joint_states', 'imu/data', 'odom'))
    assert len(joints.name) == len(joints.position) == len(joints.velocity) == 23
    assert imu.header.frame_id == 'imu_link' and imu.orientation.w == 1.0
    assert imu.linear_acceleration.z == pytest.approx(9.81)
    assert (odom.header.frame_id, odom.child_frame_id) == ('odom', 'base_link')
    assert 0.5 < odom.pose.pose.position.z < 0.9 and odom.pose.covariance[0] > 0.0
    base, footprint = watch.last['tf'].transforms
    assert (base.header.frame_id, base.child_frame_id) == ('odom', 'base_link')
    assert (footprint.header.frame_id, footprint.child_frame_id) == ('base_link', 'base_footprint')
    assert footprint.transform.translation.z == pytest.approx(-base.transform.translation.z)
    assert watch.last['walking_state'].data == 'stand'
    names = [status.name for status in watch.last['diagnostics'].status]
    assert names == ['robot: control loop', 'robot: robot']


def test_arm_follows_commands(watch: Watch) -> None:
    """An arm goes where it is commanded, and back to the walk when the commands end."""
    watch.start()
    publisher = watch.publisher(JointState, 'joint_commands')
    at_home_rad = watch.joint_rad('left_elbow')
    command = JointState(name=['left_elbow'], position=[-1.2])
    watch.keep_on(
        publisher,
        command,
        lambda: watch.joint_rad('left_elbow') == pytest.approx(-1.2, abs=0.01),
        'the elbow',
    )
    watch.ros.wait_until(
        lambda: watch.joint_rad('left_elbow') == pytest.approx(at_home_rad, abs=0.01),
        what='the way back',
    )
    assert watch.told('Refused') == 0


def test_walk(watch: Watch) -> None:
    """It walks as long as it is told to, shows its steps, and then stands."""
    for kind, topic in (
        (Odometry, 'odom'),
        (MarkerArray, 'footsteps'),
        (PointStamped, 'walking/dcm'),
        (PointStamped, 'walking/zmp'),
    ):
        watch.listen(kind, topic)
    watch.listen(String, 'walking_state', LATCHED)
    watch.start()
    forward = Twist()
    forward.linear.x = 0.2
    watch.keep_on(
        watch.publisher(Twist, 'cmd_vel'),
        forward,
        lambda: 'odom' in watch.last and watch.last['odom'].pose.pose.position.x > 0.1,
        'a step forward',
    )
    assert watch.last['walking_state'].data == 'walk'
    assert watch.last['odom'].twist.twist.linear.x > 0.0
    steps = watch.last['footsteps'].markers
    assert len(steps) > 2 and steps[1].header.frame_id == 'odom'
    colors = {(step.id % 2, step.color.g) for step in steps[1:]}
    assert len(colors) == 2, 'a number is always of the same side'
    assert 0.15 < steps[1].scale.x < 0.25 and 0.05 < steps[1].scale.y < 0.12
    assert watch.last['walking/dcm'].header.frame_id == 'odom'
    watch.ros.wait_until(lambda: watch.last['walking_state'].data == 'stand', 60.0, 'a stand')


def test_no_turn(watch: Watch) -> None:
    """It does not turn, and says so."""
    watch.start()
    turn = Twist()
    turn.angular.z = 0.3
    publisher = watch.publisher(Twist, 'cmd_vel')
    watch.keep_on(publisher, turn, lambda: watch.told('does not turn'), 'the warning')


def test_knee_is_refused_once(watch: Watch) -> None:
    """A command for a knee is refused with the reason, said once; another mode leaves it free."""
    robot = watch.start()
    publisher = watch.publisher(JointState, 'joint_commands')
    command = JointState(name=['left_knee'], position=[0.9])
    reason = "Rejected a message on 'joint_commands'. 'left_knee' is claimed by the mode 'walking'"
    watch.keep_on(publisher, command, lambda: watch.told(reason), 'the refusal')
    for _ in range(20):
        publisher.publish(command)
    assert robot.set_parameters([Parameter('mode', value='follow')])[0].successful
    watch.keep_on(
        publisher,
        command,
        lambda: watch.joint_rad('left_knee') == pytest.approx(0.9, abs=0.01),
        'the knee',
    )
    assert watch.told(reason) == 1


@pytest.mark.parametrize(
    ('kind', 'topic', 'message', 'reason'),
    [
        (
            JointState,
            'joint_commands',
            JointState(name=['left_elbw'], position=[0.0]),
            "no joint 'left_elbw'. Did you mean 'left_elbow'?",
        ),
        (
            JointState,
            'joint_commands',
            JointState(name=['left_elbow'], position=[math.nan]),
            "The position of 'left_elbow' is nan",
        ),
        (JointTrajectory, 'joint_trajectory', JointTrajectory(), 'It names no joints'),
    ],
)
def test_bad_commands(watch: Watch, kind: type, topic: str, message: Any, reason: str) -> None:
    """A command that is not sound is refused with the reason and moves nothing."""
    watch.start()
    publisher = watch.publisher(kind, topic)
    watch.keep_on(publisher, message, lambda: watch.told(reason), 'the refusal')
    assert watch.told(f"Rejected a message on '{topic}'") == 1


def test_bad_velocity(watch: Watch) -> None:
    """A velocity that is no number is refused."""
    watch.start()
    bad = Twist()
    bad.linear.x = math.nan
    watch.keep_on(
        watch.publisher(Twist, 'cmd_vel'),
        bad,
        lambda: watch.told("Rejected a message on 'cmd_vel'. The velocity (forward nan"),
        'the refusal',
    )


def test_trajectory(watch: Watch) -> None:
    """A trajectory moves a joint to its last point."""
    watch.start()
    point = JointTrajectoryPoint(positions=[0.8], time_from_start=Duration(nanosec=500_000_000))
    message = JointTrajectory(joint_names=['head_yaw'], points=[point])
    watch.publisher(JointTrajectory, 'joint_trajectory').publish(message)
    watch.ros.wait_until(lambda: watch.joint_rad('head_yaw') > 0.75, 60.0, 'the head')


def test_stop(watch: Watch) -> None:
    """A stop holds the arms where they are, and is said; after the release they move again."""
    watch.listen(String, 'stop_state', LATCHED)
    watch.listen(DiagnosticArray, 'diagnostics')
    watch.start()
    watch.wait_for('diagnostics')
    commands = watch.publisher(JointState, 'joint_commands')
    command = JointState(name=['left_elbow'], position=[-1.2])
    stop = watch.publisher(Bool, 'emergency_stop', LATCHED)
    watch.keep_on(
        commands, command, lambda: watch.joint_rad('left_elbow') < -0.6, 'a moving elbow'
    )
    stop.publish(Bool(data=True))
    watch.keep_on(commands, command, lambda: watch.told('Holding still'), 'the stop')
    watch.keep_on(
        commands,
        command,
        lambda: watch.last['diagnostics'].status[1].level == DiagnosticStatus.WARN,
        'the diagnosis',
    )
    held_rad = watch.joint_rad('left_elbow')
    assert held_rad > -1.19 and watch.last['stop_state'].data == 'the emergency stop is pressed'
    stop.publish(Bool(data=False))
    watch.keep_on(
        commands,
        command,
        lambda: watch.joint_rad('left_elbow') == pytest.approx(-1.2, abs=0.01),
        'the elbow after the release',
    )


def test_two_robots(watch: Watch) -> None:
    """Each robot has its own topics, and moves by its own commands."""
    for robot in ('robot1', 'robot2'):
        watch.listen(JointState, f'{robot}/joint_states')
    watch.ros.start(MockRobot, {'robots': ['robot1', 'robot2']})
    watch.wait_for('robot1/joint_states', 'robot2/joint_states')
    before_rad = watch.joint_rad('left_elbow', 'robot1/joint_states')
    watch.keep_on(
        watch.publisher(JointState, 'robot2/joint_commands'),
        JointState(name=['left_elbow'], position=[-1.2]),
        lambda: watch.joint_rad('left_elbow', 'robot2/joint_states') < -1.1,
        'the second robot',
    )
    assert watch.joint_rad('left_elbow', 'robot1/joint_states') == pytest.approx(before_rad)
    assert watch.node.count_publishers('joint_states') == 0


def test_other_size_and_prefix(watch: Watch) -> None:
    """The robot may have another size, and names with a prefix."""
    watch.listen(Odometry, 'odom')
    watch.start(scale=0.6, prefix='small_')
    watch.wait_for('odom')
    assert watch.last['joint_states'].name[0].startswith('small_')
    assert watch.last['odom'].child_frame_id == 'small_base_link'
    assert watch.last['odom'].pose.pose.position.z < 0.5


def test_rates(watch: Watch) -> None:
    """A rate may change while the robot runs; zero is silence."""
    robot = watch.start()
    assert robot.set_parameters([Parameter('joint_states_rate_hz', value=0.0)])[0].successful
    watch.listen(Odometry, 'odom')
    watch.wait_for('odom')

    def behind_s() -> float:
        stamps = [watch.last[topic].header.stamp for topic in ('odom', 'joint_states')]
        odom_s, joints_s = (stamp.sec + stamp.nanosec * 1e-9 for stamp in stamps)
        return float(odom_s - joints_s)

    watch.ros.wait_until(lambda: behind_s() > 0.3, what='the silence of joint_states')
