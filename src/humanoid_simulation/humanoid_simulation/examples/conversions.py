# SPDX-License-Identifier: Apache-2.0
"""What the examples make of messages, and the other way round."""

from __future__ import annotations

import math
from typing import Any

from builtin_interfaces.msg import Duration
from geometry_msgs.msg import Twist, Vector3
from humanoid_control.walking.planar import PlanarPose
from humanoid_control.walking.velocity_command import VelocityCommand
from humanoid_interfaces.srv import ApplyWrench
from humanoid_simulation.examples.fall_watch import tilt_rad
from humanoid_simulation.examples.push_series import DIRECTIONS, Push
from nav_msgs.msg import Odometry
from simulation_interfaces.msg import Result, SimulationState
from simulation_interfaces.srv import SetSimulationState


def state_request(paused: bool) -> SetSimulationState.Request:
    """Return the request to pause a simulation, or to let it go on."""
    state = SimulationState.STATE_PAUSED if paused else SimulationState.STATE_PLAYING
    return SetSimulationState.Request(state=SimulationState(state=state))


def refusal(answer: Any) -> str:
    """Return why the simulator did not do what it was asked for; empty if it did."""
    if not hasattr(answer, 'result'):
        return '' if answer.success else answer.message or 'it did not say why'
    done = (Result.RESULT_OK, SetSimulationState.Response.ALREADY_IN_TARGET_STATE)
    return '' if answer.result.result in done else answer.result.error_message


def planar_pose(message: Odometry) -> PlanarPose:
    """Return where the base is on the ground."""
    place, q = message.pose.pose.position, message.pose.pose.orientation
    yaw_rad = math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))
    return PlanarPose(complex(place.x, place.y), yaw_rad)


def height_and_tilt(message: Odometry) -> tuple[float, float]:
    """Return how high the base is, in metres, and how much it leans, in radians."""
    q = message.pose.pose.orientation
    return message.pose.pose.position.z, tilt_rad(q.x, q.y, q.z, q.w)


def twist_message(command: VelocityCommand) -> Twist:
    """Return the message of a velocity."""
    twist = Twist()
    twist.linear.x, twist.linear.y = command.forward_m_s, command.left_m_s
    twist.angular.z = command.turn_rad_s
    return twist


def push_request(
    push: Push, robot: str, pose: PlanarPose, duration_s: float
) -> ApplyWrench.Request:
    """Return the request that pushes the base of a robot that stands in a pose."""
    force_n = PlanarPose(0j, pose.yaw_rad).at(1.0, 0.0) * DIRECTIONS[push.direction]
    force_n *= push.impulse_ns / duration_s
    request = ApplyWrench.Request(entity=robot)
    request.wrench.force = Vector3(x=force_n.real, y=force_n.imag)
    request.duration = Duration(nanosec=round(duration_s * 1e9))
    return request
