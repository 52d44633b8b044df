# SPDX-License-Identifier: Apache-2.0
"""Check that the nodes of the bring-up that move anything move it the same each time."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import Twist, Vector3
from humanoid_common.qos import COMMAND, STATE
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_control.joint_controller import HumanoidJointController
from humanoid_simulation.examples.conversions import refusal, state_request
from humanoid_simulation.simulator import Simulator
from nav_msgs.msg import Odometry
import pytest
from rclpy.node import Node
from sensor_msgs.msg import JointState
from simulation_interfaces.srv import SetSimulationState, StepSimulation

pytestmark = pytest.mark.timeout(600)
STEPS = 10
"""Physics steps from one joint command to the next: 20 ms."""
COMMANDS = 60
PATIENCE_S = 60.0


class SteppedBringup:
    """The simulator and the joint controller, while time passes only by steps."""

    def __init__(self, ros: RosSandbox) -> None:
        """Wait until both hear each other, and are heard."""
        self._ros, self._node = ros, ros.observer()
        self.commands: list[tuple[int, tuple[float, ...]]] = []
        self.states: list[tuple[int, tuple[float, ...]]] = []
        self.truths: list[tuple[float, float, float]] = []
        node: Node = self._node
        node.create_subscription(JointState, 'joint_commands', self._take_command, STATE)
        node.create_subscription(JointState, 'joint_states', self._take_state, STATE)
        node.create_subscription(Odometry, 'ground_truth/odom', self._take_truth, STATE)
        self._velocity = node.create_publisher(Twist, 'cmd_vel', COMMAND)
        self._pause = node.create_client(SetSimulationState, 'simulator/set_simulation_state')
        self._step = node.create_client(StepSimulation, 'simulator/step_simulation')
        ros.wait_until(self._is_complete, PATIENCE_S, 'the whole bring-up')

    def step(self, forward_m_s: float) -> None:
        """Walk for 20 ms, and wait for the joint command that follows."""
        self._velocity.publish(Twist(linear=Vector3(x=forward_m_s)))
        # The simulator answers after it has heard what was sent to it before.
        self._ask(self._pause, state_request(paused=True))
        count = len(self.commands)
        self._ask(self._step, StepSimulation.Request(steps=STEPS))
        self._ros.wait_until(lambda: len(self.commands) > count, PATIENCE_S, 'a joint command')

    def _is_complete(self) -> bool:
        """Whether all hear each other."""
        node = self._node
        clocks = node.get_subscriptions_info_by_topic('/clock')
        return (
            self._step.service_is_ready()
            and self._pause.service_is_ready()
            and any('joint_controller' in clock.node_name for clock in clocks)
            and node.count_publishers('joint_commands') == 1
            and node.count_publishers('joint_states') == 1
            and self._velocity.get_subscription_count() == 1
        )

    def _ask(self, client: Any, request: Any) -> None:
        """Call a service that must do what it is asked for."""
        future = client.call_async(request)
        self._ros.wait_until(future.done, PATIENCE_S, client.srv_name)
        assert not refusal(future.result())

    def _take_command(self, message: JointState) -> None:
        self.commands.append((_nanoseconds(message), tuple(message.position)))

    def _take_state(self, message: JointState) -> None:
        self.states.append((_nanoseconds(message), tuple(message.position)))

    def _take_truth(self, message: Odometry) -> None:
        place = message.pose.pose.position
        self.truths.append((place.x, place.y, place.z))


def _nanoseconds(message: JointState) -> int:
    return int(message.header.stamp.sec * 1_000_000_000 + message.header.stamp.nanosec)


def stepped() -> SteppedBringup:
    """Return what all said in a run in which the robot walks and swings its arms."""
    noisy = {'camera_rate_hz': 0.0, 'start_paused': True, 'sensor_noise': 1.0, 'seed': 3}
    with ros_sandbox() as ros:
        ros.start(Simulator, noisy)
        ros.start(HumanoidJointController, {'use_sim_time': True})
        bringup = SteppedBringup(ros)
        for _ in range(COMMANDS):
            bringup.step(0.3)
        ros.wait_until(lambda: len(bringup.states) >= COMMANDS, PATIENCE_S, 'all joint states')
        ros.wait_until(lambda: len(bringup.truths) >= COMMANDS, PATIENCE_S, 'all poses')
        return bringup


def test_the_same_motion_twice() -> None:
    """Arms and walk are the same, number by number; time that stands still moves nothing."""
    first, second = stepped(), stepped()
    period_ns = 20_000_000
    assert [stamp for stamp, _ in first.commands] == [
        period_ns * (number + 1) for number in range(COMMANDS)
    ]
    assert first.commands == second.commands
    assert first.states == second.states
    assert first.truths == second.truths
    assert first.truths[-1][0] - first.truths[0][0] > 0.01
    assert first.commands[-1][1][0] > 0.3
