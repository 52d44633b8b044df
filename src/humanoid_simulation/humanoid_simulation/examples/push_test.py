# SPDX-License-Identifier: Apache-2.0
"""Find the strongest pushes the robot withstands: `ros2 run humanoid_simulation push_test`."""

from __future__ import annotations

from dataclasses import dataclass
import sys
from typing import Any

from humanoid_common.node_parameters import NodeParameters
from humanoid_common.parameters import parameter, ParameterError
from humanoid_common.qos import STATE
from humanoid_common.running import ending, run_node
from humanoid_control.hosting.conversions import seconds
from humanoid_interfaces.srv import ApplyWrench
from humanoid_simulation.examples.conversions import (
    height_and_tilt,
    planar_pose,
    push_request,
    refusal,
)
from humanoid_simulation.examples.fall_watch import FallWatch
from humanoid_simulation.examples.needs_simulator import ExampleError, SimulatorWatch
from humanoid_simulation.examples.push_series import (
    NextAction,
    PushPlan,
    PushSeries,
)
from nav_msgs.msg import Odometry
import rclpy
from rclpy.client import Client
from rclpy.node import Node
from rclpy.task import Future
from simulation_interfaces.srv import ResetSimulation


@dataclass(frozen=True)
class PushTestParameters:
    """Parameters of `push_test`: impulses and duration of the pushes."""

    first_ns: float = parameter(
        5.0, 'The weakest impulse, in N s.', at_least=0.1, at_most=1000.0, read_only=True
    )
    step_ns: float = parameter(
        5.0,
        'By how much each impulse exceeds the one before, in N s.',
        at_least=0.1,
        at_most=1000.0,
        read_only=True,
    )
    most_ns: float = parameter(
        30.0, 'The strongest impulse, in N s.', at_least=0.1, at_most=1000.0, read_only=True
    )
    duration_s: float = parameter(
        0.1, 'Duration of a push.', at_least=0.002, at_most=0.9, read_only=True
    )
    simulator: str = parameter(
        '/simulator',
        'The full name of the simulator node, whose services are used.',
        read_only=True,
    )

    def __post_init__(self) -> None:
        """Check that the range of impulses is not empty."""
        if self.first_ns > self.most_ns:
            raise ParameterError(
                f"Parameter 'first_ns' is {self.first_ns:g}, but must not be more than "
                f"'most_ns', which is {self.most_ns:g}.",
                'first_ns',
                'most_ns',
            )

    @property
    def plan(self) -> PushPlan:
        """Return the plan that the parameters describe."""
        return PushPlan(self.first_ns, self.step_ns, self.most_ns)


class PushTest(Node):
    """
    Node that pushes the robot harder and harder, and resets the simulation after each push.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('push_test', **options)
        self._parameters = NodeParameters(self, PushTestParameters).current
        self._series = PushSeries(self._parameters.plan)
        self._fall_watch = FallWatch()
        self._waits = False
        name = self._parameters.simulator
        self._push = self.create_client(ApplyWrench, f'{name}/apply_wrench')
        self._reset = self.create_client(ResetSimulation, f'{name}/reset_simulation')
        self._simulator = SimulatorWatch(self, "'ground_truth/odom'")
        go_on = ending(self, self._go_on)
        self.create_subscription(Odometry, 'ground_truth/odom', go_on, STATE)

    def _go_on(self, message: Odometry) -> None:
        """Execute the next step of the series, unless a response is pending."""
        self._simulator.heard()
        if self._waits:
            return
        stands = self._fall_watch.stands(*height_and_tilt(message))
        step = self._series.update(seconds(message.header.stamp), stands)
        if step is NextAction.PUSH:
            self._send_push(message)
        elif step is NextAction.RESET:
            self._send(self._reset, ResetSimulation.Request())
        elif step is NextAction.DONE:
            self._report()

    def _send_push(self, message: Odometry) -> None:
        """Request the due push from the simulator."""
        robot, push = self.get_namespace().strip('/'), self._series.push
        self.get_logger().info(f'Pushing {push.direction}: {push.impulse_ns:g} N s')
        pose, duration_s = planar_pose(message), self._parameters.duration_s
        self._send(self._push, push_request(push, robot, pose, duration_s))

    def _send(self, client: Client, request: Any) -> None:
        """Send a request; nothing else is done until its response arrives."""
        if not client.service_is_ready():
            raise ExampleError(
                f"There is no service '{client.srv_name}'. If the simulator has another name, "
                'pass it: --ros-args -p simulator:=/its/name'
            )
        self._waits = True
        client.call_async(request).add_done_callback(ending(self, self._take_answer))

    def _take_answer(self, future: Future) -> None:
        """Continue, or raise ExampleError if the request was rejected."""
        reason = refusal(future.result())
        if reason:
            raise ExampleError(f'The simulator rejected the request: {reason}')
        self._waits = False

    def _report(self) -> None:
        """Log the strongest push that the robot withstood in each direction, and shut down."""
        for direction, impulse_ns in self._series.stood_ns.items():
            self.get_logger().info(f'Strongest push withstood, {direction}: {impulse_ns:g} N s')
        rclpy.try_shutdown(context=self.context)


def main() -> int:
    """Run the node."""
    return run_node(PushTest)


if __name__ == '__main__':
    sys.exit(main())
