# SPDX-License-Identifier: Apache-2.0
"""Check the simulator in this process: its topics and services."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from geometry_msgs.msg import Vector3, WrenchStamped
from humanoid_common.errors import NodeStartError
from humanoid_common.parameters import ParameterError
from humanoid_common.qos import SENSOR
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_interfaces.msg import Contacts
from humanoid_interfaces.srv import (
    ApplyWrench,
    ResetSimulation,
    SetEntityState,
    StepSimulation,
)
from humanoid_simulation.simulator import Simulator
from nav_msgs.msg import Odometry
import pytest
from rclpy.parameter import Parameter
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64
from std_srvs.srv import SetBool, Trigger

HEADLESS = {'camera_rate_hz': 0.0, 'real_time_factor': 0.0}


class Watch:
    """A simulator, what it says, and how to ask it for something."""

    def __init__(self, ros: RosSandbox, **parameters: Any) -> None:
        """Start the simulator, as fast as possible, and without a camera."""
        self.ros, self.node = ros, ros.observer()
        self.last: dict[str, Any] = {}
        self.times_s: list[float] = []
        self.node.create_subscription(Clock, '/clock', self._hear_time, 10)
        self.simulator = ros.start(Simulator, {**HEADLESS, **parameters})

    def _hear_time(self, message: Clock) -> None:
        self.times_s.append(message.clock.sec + message.clock.nanosec * 1e-9)

    def listen(self, kind: type, topic: str) -> None:
        """Keep the newest message of a topic."""

        def keep(message: Any) -> None:
            self.last[topic] = message

        self.node.create_subscription(kind, topic, keep, SENSOR)

    def wait(self, what: str, condition: Callable[[], bool]) -> None:
        """Spin until a condition holds."""
        self.ros.wait_until(condition, 30.0, what)

    def wait_for(self, *topics: str) -> None:
        """Wait for new messages."""
        for topic in topics:
            self.last.pop(topic, None)
        self.wait(f'all of {topics}', lambda: set(topics) <= set(self.last))

    def run(self, seconds: float) -> None:
        """Let time pass in the world."""
        self.wait('a time', lambda: bool(self.times_s))
        end_s = self.times_s[-1] + seconds
        self.wait('the time to pass', lambda: self.times_s[-1] >= end_s)

    def ask(self, kind: type, name: str, **request: Any) -> Any:
        """Call a service."""
        client = self.node.create_client(kind, name)
        self.wait(name, client.service_is_ready)
        future = client.call_async(kind.Request(**request))
        self.wait(f'an answer of {name}', future.done)
        self.node.destroy_client(client)
        return future.result()

    def pause(self, on: bool = True) -> Any:
        """Let time stand still, or go on."""
        return self.ask(SetBool, 'simulator/set_pause', data=on)


@pytest.fixture
def ros() -> Iterator[RosSandbox]:
    """Give a domain of one's own."""
    with ros_sandbox() as sandbox:
        yield sandbox


def test_it_tells_time_truth_contacts_and_wrenches(ros: RosSandbox) -> None:
    """All topics come, in their frames; the feet carry the robot."""
    watch = Watch(ros)
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
    watch = Watch(ros)
    stamps: list[Any] = []
    watch.node.create_subscription(
        JointState, 'joint_states', lambda message: stamps.append(message.header.stamp), 10
    )
    watch.wait('joint states', lambda: len(stamps) > 5)
    assert all(stamp.sec or stamp.nanosec for stamp in stamps)


def test_pause_step_and_go_on(ros: RosSandbox) -> None:
    """Paused, time stands still but for steps, which are whole control periods."""
    watch = Watch(ros)
    watch.run(0.1)
    refused = watch.ask(StepSimulation, 'simulator/step_simulation', steps=5)
    assert not refused.success and 'Pause it before' in refused.message
    assert watch.pause().success
    before_s = watch.simulator._backend.time_s
    done = watch.ask(StepSimulation, 'simulator/step_simulation', steps=11)
    assert done.success and '15 steps of physics: 3 control periods' in done.message
    assert watch.simulator._backend.time_s == pytest.approx(before_s + 0.03)
    for steps in (0, 10**9):
        refused = watch.ask(StepSimulation, 'simulator/step_simulation', steps=steps)
        assert not refused.success and 'Give 1 to 100000' in refused.message
    assert watch.pause(False).success
    watch.run(0.5)


def test_many_steps_leave_the_simulator_responsive(ros: RosSandbox) -> None:
    """While they are computed, other services answer; set_pause ends them."""
    watch = Watch(ros, start_paused=True)
    client = watch.node.create_client(StepSimulation, 'simulator/step_simulation')
    watch.wait('the service', client.service_is_ready)
    steps = client.call_async(StepSimulation.Request(steps=100_000))
    watch.wait('the first steps', lambda: watch.simulator._backend.time_s > 0.1)
    assert watch.ask(ResetSimulation, 'simulator/reset_simulation').success
    assert not steps.done()
    assert watch.pause().success
    watch.wait('the answer', steps.done)
    assert not steps.result().success and 'ended by set_pause' in steps.result().message
    assert watch.ask(StepSimulation, 'simulator/step_simulation', steps=50).success


def test_it_may_start_paused(ros: RosSandbox) -> None:
    """Then no time passes before somebody wants it."""
    watch = Watch(ros, start_paused=True)
    assert watch.ask(StepSimulation, 'simulator/step_simulation', steps=5).success
    assert watch.simulator._backend.time_s == pytest.approx(0.01)
    watch.pause(False)
    watch.run(0.1)


def test_time_never_goes_back(ros: RosSandbox) -> None:
    """A reset puts the robot back, not the clock."""
    watch = Watch(ros)
    watch.listen(Odometry, 'ground_truth/odom')
    watch.ask(SetEntityState, 'simulator/set_entity_state', entity='', **state_at(1.0, 2.0, 0.75))
    watch.wait_for('ground_truth/odom')
    y_m = lambda: watch.last['ground_truth/odom'].pose.pose.position.y  # noqa: E731
    watch.wait('the robot to be there', lambda: abs(y_m() - 2.0) < 0.2)
    assert watch.ask(ResetSimulation, 'simulator/reset_simulation').success
    watch.wait('the robot to be back', lambda: abs(y_m()) < 0.1)
    watch.run(0.2)
    assert watch.times_s == sorted(watch.times_s)
    refused = watch.ask(ResetSimulation, 'simulator/reset_simulation', keyframe='hme')
    assert not refused.success and "Did you mean 'home'" in refused.message


def state_at(x: float, y: float, z: float) -> dict[str, Any]:
    """Return the parts of a request to put something somewhere."""
    request = SetEntityState.Request()
    request.pose.position.x, request.pose.position.y, request.pose.position.z = x, y, z
    return {'pose': request.pose, 'twist': request.twist}


def test_things_and_robots_are_put_and_pushed(ros: RosSandbox) -> None:
    """By their names; names that nobody has are refused with the right one."""
    watch = Watch(ros, scene='push_test')
    put, push = 'simulator/set_entity_state', 'simulator/apply_wrench'
    assert watch.ask(SetEntityState, put, entity='ball_3kg', **state_at(3.0, 3.0, 0.12)).success
    answer = watch.ask(SetEntityState, put, entity='bal_3kg', **state_at(3.0, 3.0, 0.12))
    assert not answer.success and "Did you mean 'ball_3kg'" in answer.message
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
    watch = Watch(ros)
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
    watch = Watch(ros)
    watch.ask(ApplyWrench, 'simulator/apply_wrench', **wrench(x=1e15))
    watch.wait('the failure', lambda: watch.simulator._host.paused)
    answer = watch.pause(False)
    assert not answer.success and 'reset the simulation first' in answer.message
    answer = watch.ask(StepSimulation, 'simulator/step_simulation', steps=5)
    assert not answer.success and 'has failed' in answer.message
    assert watch.ask(ResetSimulation, 'simulator/reset_simulation').success
    watch.run(0.5)


def test_a_pause_outlasts_a_failure(ros: RosSandbox) -> None:
    """Physics that fails while it is stepped is still paused after the reset."""
    watch = Watch(ros, start_paused=True)
    step = 'simulator/step_simulation'
    watch.ask(ApplyWrench, 'simulator/apply_wrench', **wrench(x=1e15))
    answer = watch.ask(StepSimulation, step, steps=500)
    assert not answer.success and 'failed meanwhile' in answer.message
    for name, kind in (('simulator/set_entity_state', SetEntityState), ('stand_up', Trigger)):
        answer = watch.ask(kind, name)
        assert not answer.success
    assert watch.ask(ResetSimulation, 'simulator/reset_simulation').success
    assert watch.simulator._host.paused
    assert watch.ask(StepSimulation, step, steps=5).success


def test_two_robots_in_their_namespaces(ros: RosSandbox) -> None:
    """Each has its topics; they share the time."""
    watch = Watch(ros, robots=['robot1', 'robot2'])
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
    watch = Watch(ros)
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
    with pytest.raises(NodeStartError, match=sentence):
        Watch(ros, **parameters)


def test_rates_that_do_not_fit_are_refused(ros: RosSandbox) -> None:
    """A control period is a whole number of physics steps."""
    with pytest.raises(ParameterError, match='no multiple'):
        Watch(ros, physics_rate_hz=500.0, control_rate_hz=150.0)
