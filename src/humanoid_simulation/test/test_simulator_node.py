# SPDX-License-Identifier: Apache-2.0
"""Check the simulator in this process: its topics and services."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from geometry_msgs.msg import Vector3, WrenchStamped
from humanoid_common.errors import UserError
from humanoid_common.parameters import ParameterError
from humanoid_common.qos import LATCHED
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_interfaces.msg import Contacts
from humanoid_interfaces.srv import ApplyWrench
from humanoid_simulation.examples.conversions import refusal
from humanoid_simulation.testing.watched_simulator import WatchedSimulator
from nav_msgs.msg import Odometry
import pytest
from rclpy.parameter import Parameter
from sensor_msgs.msg import Imu, JointState
from simulation_interfaces.srv import (
    StepSimulation,
)
from std_msgs.msg import Float64, String
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage


@pytest.fixture
def ros() -> Iterator[RosSandbox]:
    """Give a domain of one's own."""
    with ros_sandbox() as sandbox:
        yield sandbox


def test_it_tells_time_truth_contacts_and_wrenches(ros: RosSandbox) -> None:
    """All topics come, in their frames; the feet carry the robot."""
    watch = WatchedSimulator(ros)
    for kind, topic in (
        (JointState, 'joint_states'),
        (Odometry, 'ground_truth/odom'),
        (Contacts, 'contacts'),
        (WrenchStamped, 'l_sole/wrench'),
        (WrenchStamped, 'r_sole/wrench'),
    ):
        watch.listen(kind, topic)
    watch.run(1.0)
    watch.wait_for('joint_states', 'ground_truth/odom', 'contacts', 'l_sole/wrench')
    watch.wait_for('r_sole/wrench')
    truth, left = watch.last['ground_truth/odom'], watch.last['l_sole/wrench']
    assert (truth.header.frame_id, truth.child_frame_id) == ('world', 'base_link')
    assert 0.6 < truth.pose.pose.position.z < 0.75
    assert left.header.frame_id == 'l_sole'
    assert left.wrench.force.z == pytest.approx(42.8 * 9.81 / 2, rel=0.1)
    contacts = watch.last['contacts']
    assert contacts.header.frame_id == 'world'
    assert {contact.body2 for contact in contacts.contacts} == {'left_foot', 'right_foot'}
    assert all(contact.normal.z == pytest.approx(1.0) for contact in contacts.contacts)


def test_no_message_is_stamped_with_zero(ros: RosSandbox) -> None:
    """ROS takes a time of zero for none, and so the first stamp is later."""
    watch = WatchedSimulator(ros)
    stamps: list[Any] = []
    watch.node.create_subscription(
        JointState, 'joint_states', lambda message: stamps.append(message.header.stamp), 10
    )
    watch.wait('joint states', lambda: len(stamps) > 5)
    assert all(stamp.sec or stamp.nanosec for stamp in stamps)


def test_pause_step_and_go_on(ros: RosSandbox) -> None:
    """Paused, time stands still but for steps, which are whole control periods."""
    watch = WatchedSimulator(ros)
    watch.run(0.1)
    assert 'Pause it before' in watch.step(5)
    assert not watch.pause()
    before_s = watch.simulator._backend.time_s
    assert not watch.step(11)  # 15 steps of physics, 3 control periods
    assert watch.simulator._backend.time_s == pytest.approx(before_s + 0.03)
    for steps in (0, 10**9):
        assert 'Give 1 to 100000' in watch.step(steps)
    assert not watch.pause(False)
    watch.run(0.5)


def test_many_steps_leave_the_simulator_responsive(ros: RosSandbox) -> None:
    """While they are computed, other services answer; another pause ends them."""
    watch = WatchedSimulator(ros, start_paused=True)
    client = watch.node.create_client(StepSimulation, 'simulator/step_simulation')
    watch.wait('the service', client.service_is_ready)
    steps = client.call_async(StepSimulation.Request(steps=100_000))
    watch.wait('the first steps', lambda: watch.simulator._backend.time_s > 0.1)
    assert not watch.reset()
    assert not steps.done()
    assert not watch.pause()
    watch.wait('the answer', steps.done)
    assert 'ended by another request' in refusal(steps.result())
    assert not watch.step(50)


def test_it_may_start_paused(ros: RosSandbox) -> None:
    """Then no time passes before somebody wants it."""
    watch = WatchedSimulator(ros, start_paused=True)
    assert not watch.step(5)
    assert watch.simulator._backend.time_s == pytest.approx(0.01)
    watch.pause(False)
    watch.run(0.1)


def test_time_never_goes_back(ros: RosSandbox) -> None:
    """A reset puts the robot back, not the clock."""
    watch = WatchedSimulator(ros)
    watch.listen(Odometry, 'ground_truth/odom')
    assert not watch.put('', 1.0, 2.0, 0.75)
    watch.wait_for('ground_truth/odom')
    y_m = lambda: watch.last['ground_truth/odom'].pose.pose.position.y  # noqa: E731
    watch.wait('the robot to be there', lambda: abs(y_m() - 2.0) < 0.2)
    assert not watch.reset()
    watch.wait('the robot to be back', lambda: abs(y_m()) < 0.1)
    watch.run(0.2)
    assert watch.times_s == sorted(watch.times_s)
    (refused,) = watch.simulator.set_parameters([Parameter('reset_keyframe', value='hme')])
    assert not refused.successful and "Did you mean 'home'" in refused.reason


def test_things_and_robots_are_put_and_pushed(ros: RosSandbox) -> None:
    """By their names; names that nobody has are refused with the right one."""
    watch = WatchedSimulator(ros, scene='push_test')
    push = 'simulator/apply_wrench'
    assert not watch.put('ball_3kg', 3.0, 3.0, 0.12)
    assert "Did you mean 'ball_3kg'" in watch.put('bal_3kg', 3.0, 3.0, 0.12)
    assert watch.ask(ApplyWrench, push, entity='ball_3kg', **wrench(x=60.0)).success
    watch.run(0.5)
    assert watch.simulator._backend.entity_state('ball_3kg').position_m[0] > 3.05
    answer = watch.ask(ApplyWrench, push, body='tors', **wrench(x=1.0))
    assert not answer.success and "Did you mean 'torso'" in answer.message
    answer = watch.ask(ApplyWrench, push, **wrench(x=1.0, nanoseconds=0))
    assert not answer.success and 'above zero' in answer.message


def wrench(x: float, nanoseconds: int = 100_000_000) -> dict[str, Any]:
    """Return the parts of a request to push along x."""
    request = ApplyWrench.Request()
    request.wrench.force = Vector3(x=x)
    request.duration.nanosec = nanoseconds
    return {'wrench': request.wrench, 'duration': request.duration}


def test_a_robot_that_was_knocked_down_stands_up(ros: RosSandbox) -> None:
    """The service helps it onto its feet, where it stays."""
    watch = WatchedSimulator(ros)
    watch.listen(Odometry, 'ground_truth/odom')
    height_m = lambda: watch.last['ground_truth/odom'].pose.pose.position.z  # noqa: E731
    watch.ask(ApplyWrench, 'simulator/apply_wrench', body='torso', **wrench(x=3000.0))
    watch.wait_for('ground_truth/odom')
    watch.wait('the fall', lambda: height_m() < 0.4)
    assert watch.ask(Trigger, 'stand_up').success
    watch.wait_for('ground_truth/odom')
    watch.wait('the robot to stand', lambda: height_m() > 0.65)
    watch.run(2.0)
    assert height_m() > 0.65


def test_physics_that_fails_is_reported_and_a_reset_helps(ros: RosSandbox) -> None:
    """The simulator stays, says why it stands still, and goes on after a reset."""
    watch = WatchedSimulator(ros)
    watch.ask(ApplyWrench, 'simulator/apply_wrench', **wrench(x=1e15))
    watch.wait('the failure', lambda: watch.simulator._host.paused)
    assert 'reset the simulation first' in watch.pause(False)
    assert 'has failed' in watch.step(5)
    assert not watch.reset()
    watch.run(0.5)


def test_a_pause_outlasts_a_failure(ros: RosSandbox) -> None:
    """Physics that fails while it is stepped is still paused after the reset."""
    watch = WatchedSimulator(ros, start_paused=True)
    watch.ask(ApplyWrench, 'simulator/apply_wrench', **wrench(x=1e15))
    assert 'failed during the steps' in watch.step(500)
    assert 'has failed' in watch.put('', 0.0, 0.0, 1.0)
    assert not watch.ask(Trigger, 'stand_up').success
    assert not watch.reset()
    assert watch.simulator._host.paused
    assert not watch.step(5)


def test_two_robots_in_their_namespaces(ros: RosSandbox) -> None:
    """Each has its topics; they share the time."""
    watch = WatchedSimulator(ros, robots=['robot1', 'robot2'])
    for robot in ('robot1', 'robot2'):
        watch.listen(Odometry, f'{robot}/ground_truth/odom')
        watch.listen(JointState, f'{robot}/joint_states')
        watch.listen(Contacts, f'{robot}/contacts')
    watch.run(0.2)
    watch.wait_for(*watch.last)
    truth = watch.last['robot2/ground_truth/odom']
    assert truth.pose.pose.position.y == pytest.approx(1.0, abs=0.05)
    feet = {contact.body2 for contact in watch.last['robot2/contacts'].contacts}
    assert feet == {'robot2/left_foot', 'robot2/right_foot'}
    assert watch.ask(Trigger, 'robot2/stand_up').success


def test_how_fast_time_passes_is_a_parameter_and_is_measured(ros: RosSandbox) -> None:
    """A factor of a half makes the clock slow, and that is what the topic says."""
    watch = WatchedSimulator(ros)
    watch.listen(Float64, 'real_time_factor')
    watch.wait_for('real_time_factor')
    watch.simulator.set_parameters([Parameter('real_time_factor', value=0.5)])
    watch.wait_for('real_time_factor')
    near = lambda: abs(watch.last['real_time_factor'].data - 0.5) < 0.1  # noqa: E731
    watch.wait('the factor', near)


@pytest.mark.parametrize(
    ('parameters', 'sentence'),
    [
        ({'scene': 'rom'}, "no scene 'rom'. Did you mean 'room'"),
        ({'scene': 'x.yaml'}, 'x.yaml cannot be read'),
    ],
)
def test_a_start_that_fails_says_why(ros: RosSandbox, parameters, sentence: str) -> None:
    """The node does not start, with a sentence."""
    with pytest.raises(UserError, match=sentence):
        WatchedSimulator(ros, **parameters)


def test_rates_that_do_not_fit_are_refused(ros: RosSandbox) -> None:
    """A control period is a whole number of physics steps."""
    with pytest.raises(ParameterError, match='not a multiple'):
        WatchedSimulator(ros, physics_rate_hz=500.0, control_rate_hz=150.0)


@pytest.mark.parametrize('keyframe', ['lying_on_back', 'lying_on_face'])
def test_a_robot_that_lies_says_where_it_is(ros: RosSandbox, keyframe: str) -> None:
    """After a reset onto the ground, state, odometry and transforms are there at once."""
    watch = WatchedSimulator(
        ros,
        start_paused=True,
        sensor_noise=1.0,
        world_frame_rate_hz=0.0,
        reset_keyframe=keyframe,
    )
    watch.listen(Odometry, 'odom')
    watch.listen(TFMessage, 'tf')
    watch.listen(Odometry, 'ground_truth/odom')
    states: list[str] = []
    watch.node.create_subscription(
        String, 'walking_state', lambda message: states.append(message.data), LATCHED
    )
    assert not watch.step(50)
    watch.wait('a robot that stands', lambda: states == ['stand'])
    assert not watch.reset()
    watch.last.clear()
    # Odometry and truth are published in every second control period.
    assert not watch.step(10)
    watch.wait('the new state', lambda: states == ['stand', 'fallen'])
    watch.wait('all topics', lambda: len(watch.last) == 3)
    height_m = watch.last['odom'].pose.pose.position.z
    assert height_m == pytest.approx(watch.last['ground_truth/odom'].pose.pose.position.z, abs=0.1)
    assert watch.last['tf'].transforms[0].transform.translation.z == height_m


def test_covariances_are_those_of_the_noise(ros: RosSandbox) -> None:
    """The inertial sensor says how far it is off; its heading, and odometry's, get worse."""
    watch = WatchedSimulator(ros, sensor_noise=1.0)
    watch.listen(Imu, 'imu/data')
    watch.listen(Odometry, 'odom')
    watch.wait_for('imu/data', 'odom')
    early, walked = watch.last['imu/data'], watch.last['odom']
    # Odometry reckons in pieces of half a second.
    watch.run(0.6)
    watch.wait_for('imu/data', 'odom')
    late, later = watch.last['imu/data'], watch.last['odom']
    assert early.angular_velocity_covariance[0] == pytest.approx(0.01**2 + 0.002**2)
    assert early.linear_acceleration_covariance[8] == pytest.approx(0.1**2 + 0.05**2)
    assert early.orientation_covariance[0] == late.orientation_covariance[4] > 0.003**2
    assert 0.0 <= early.orientation_covariance[8] < late.orientation_covariance[8]
    assert 0.0 < walked.pose.covariance[35] < later.pose.covariance[35]
