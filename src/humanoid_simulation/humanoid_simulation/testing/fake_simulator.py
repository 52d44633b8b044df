# SPDX-License-Identifier: Apache-2.0
"""A fake simulator, for tests of nodes that drive and push a robot."""

from __future__ import annotations

import math
from typing import Any

from builtin_interfaces.msg import Time
from geometry_msgs.msg import Twist
from humanoid_common.qos import COMMAND, LATCHED, STATE
from humanoid_control.walking.planar import PlanarPose
from humanoid_interfaces.srv import ApplyWrench
from nav_msgs.msg import Odometry
from rclpy.node import Node
from simulation_interfaces.msg import Result, SimulationState
from simulation_interfaces.srv import ResetSimulation, SetSimulationState, StepSimulation
from std_msgs.msg import String

PERIOD_S = 0.02
FASTER = 5
"""The real-time factor."""
STANDS_NS = 12.0
"""The impulse above which the robot falls."""
STEPS_A_PERIOD = 10
VELOCITY_LASTS_S = 0.5
"""Timeout of commands, as of a real robot: a node that stalls must not drive it blindly."""
START = PlanarPose(1 + 2j, 0.5)


class FakeSimulator(Node):
    """
    A robot that follows velocity commands exactly, without physics and without `/clock`.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('simulator', **options)
        self.velocity = Twist()
        self.pushes: list[ApplyWrench.Request] = []
        self.refuses = ''
        """The message with which pushes are rejected; empty if they are accepted."""
        self._pose, self._time_s = START, 0.0
        self._heard_s = -math.inf
        self._lies = self._pauses = False
        self._odometries = [
            self.create_publisher(Odometry, topic, STATE)
            for topic in ('ground_truth/odom', 'odom')
        ]
        self._state = self.create_publisher(String, 'walking_state', LATCHED)
        self._state.publish(String(data='stand'))
        self.create_subscription(Twist, 'cmd_vel', self._obey, COMMAND)
        self.create_service(ApplyWrench, '~/apply_wrench', self._be_pushed)
        self.create_service(ResetSimulation, '~/reset_simulation', self._begin_anew)
        self.create_service(SetSimulationState, '~/set_simulation_state', self._pause)
        self.create_service(StepSimulation, '~/step_simulation', self._go_on)
        self.create_timer(PERIOD_S / FASTER, self._tick)

    def _obey(self, message: Twist) -> None:
        """Store a velocity command."""
        self.velocity, self._heard_s = message, self._time_s

    def _be_pushed(
        self, request: ApplyWrench.Request, response: ApplyWrench.Response
    ) -> ApplyWrench.Response:
        """Fall if the impulse is too large."""
        self.pushes.append(request)
        force, duration_s = request.wrench.force, request.duration.nanosec * 1e-9
        self._lies = math.hypot(force.x, force.y) * duration_s > STANDS_NS
        response.success, response.message = not self.refuses, self.refuses
        return response

    def _begin_anew(
        self, request: ResetSimulation.Request, response: ResetSimulation.Response
    ) -> ResetSimulation.Response:
        """Reset the robot to its start."""
        self._lies, self._pose = False, START
        response.result.result = Result.RESULT_OK
        return response

    def _pause(
        self, request: SetSimulationState.Request, response: SetSimulationState.Response
    ) -> SetSimulationState.Response:
        """Pause or resume the simulation."""
        self._pauses = request.state.state == SimulationState.STATE_PAUSED
        response.result.result = Result.RESULT_OK
        return response

    def _go_on(
        self, request: StepSimulation.Request, response: StepSimulation.Response
    ) -> StepSimulation.Response:
        """Advance the simulation by some steps."""
        for _ in range(request.steps // STEPS_A_PERIOD):
            self._step()
        response.result.result = Result.RESULT_OK
        return response

    def _tick(self) -> None:
        """Advance the simulation by a period unless it is paused."""
        if not self._pauses:
            self._step()

    def _step(self) -> None:
        """Advance the simulation by a period, and publish the odometry."""
        self._time_s += PERIOD_S
        is_new = self._time_s - self._heard_s < VELOCITY_LASTS_S
        go = self.velocity if is_new else Twist()
        yaw_rad = self._pose.yaw_rad + go.angular.z * PERIOD_S
        place = self._pose.at(go.linear.x * PERIOD_S, go.linear.y * PERIOD_S)
        self._pose = PlanarPose(place, yaw_rad)
        message = self._odometry()
        for publisher in self._odometries:
            publisher.publish(message)

    def _odometry(self) -> Odometry:
        """Build the odometry message of the present pose."""
        message = Odometry()
        message.header.stamp = Time(sec=int(self._time_s), nanosec=int(self._time_s % 1 * 1e9))
        pose, yaw_rad = message.pose.pose, self._pose.yaw_rad
        pose.position.x, pose.position.y = self._pose.position_m.real, self._pose.position_m.imag
        pose.position.z = 0.1 if self._lies else 0.7
        pose.orientation.w, pose.orientation.z = math.cos(yaw_rad / 2), math.sin(yaw_rad / 2)
        return message
