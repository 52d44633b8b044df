# SPDX-License-Identifier: Apache-2.0
"""Convert messages to the types of the examples, and vice versa."""

from __future__ import annotations

import math
from typing import Any

from builtin_interfaces.msg import Duration
from geometry_msgs.msg import Twist, Vector3
from humanoid_control.walking.commands import VelocityCommand
from humanoid_control.walking.planar import PlanarPose
from humanoid_interfaces.srv import ApplyWrench
from humanoid_simulation.examples.fall_watch import tilt_rad
from humanoid_simulation.examples.push_series import DIRECTIONS, Push
from nav_msgs.msg import Odometry
from simulation_interfaces.msg import Result, SimulationState
from simulation_interfaces.srv import SetSimulationState


def state_request(paused: bool) -> SetSimulationState.Request:
    """
    Build the request that pauses or resumes the simulation.

    Parameters
    ----------
    paused
        Whether to pause it.

    """
    state = SimulationState.STATE_PAUSED if paused else SimulationState.STATE_PLAYING
    return SetSimulationState.Request(state=SimulationState(state=state))


def refusal(answer: Any) -> str:
    """
    Extract the reason why the simulator rejected a request; '' if it did not.

    Parameters
    ----------
    answer
        Response of any service of the simulator, with a `result`, or `success` and `message`.

    """
    if not hasattr(answer, 'result'):
        return '' if answer.success else answer.message or 'it did not say why'
    done = (Result.RESULT_OK, SetSimulationState.Response.ALREADY_IN_TARGET_STATE)
    return '' if answer.result.result in done else answer.result.error_message


def planar_pose(message: Odometry) -> PlanarPose:
    """
    Project the pose of an odometry message onto the ground.

    Parameters
    ----------
    message
        Odometry, or ground truth.

    Returns
    -------
    PlanarPose
        The pose of the base, in the frame of the message's header.

    """
    place, q = message.pose.pose.position, message.pose.pose.orientation
    yaw_rad = math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))
    return PlanarPose(complex(place.x, place.y), yaw_rad)


def height_and_tilt(message: Odometry) -> tuple[float, float]:
    """
    Extract the height and the tilt of the base from an odometry message.

    Parameters
    ----------
    message
        Odometry, or ground truth.

    Returns
    -------
    tuple[float, float]
        Height in m in the frame of the header, and the angle to the vertical in rad.

    """
    q = message.pose.pose.orientation
    return message.pose.pose.position.z, tilt_rad(q.x, q.y, q.z, q.w)


def twist_message(command: VelocityCommand) -> Twist:
    """
    Convert a velocity command to the message of `cmd_vel`.

    Parameters
    ----------
    command
        The velocity, in the axes of the robot.

    """
    twist = Twist()
    twist.linear.x, twist.linear.y = command.forward_m_s, command.left_m_s
    twist.angular.z = command.turn_rad_s
    return twist


def push_request(
    push: Push, robot: str, pose: PlanarPose, duration_s: float
) -> ApplyWrench.Request:
    """
    Build the request that pushes the base of a robot horizontally.

    Parameters
    ----------
    push
        Its direction relative to the robot, and its impulse.
    robot
        Namespace of the robot; '' if it has none.
    pose
        Its pose in the world, whose yaw rotates the force into world axes.
    duration_s
        Duration of the push, less than 1 s; the force is the impulse divided by it.

    """
    force_n = PlanarPose(0j, pose.yaw_rad).at(1.0, 0.0) * DIRECTIONS[push.direction]
    force_n *= push.impulse_ns / duration_s
    request = ApplyWrench.Request(entity=robot)
    request.wrench.force = Vector3(x=force_n.real, y=force_n.imag)
    request.duration = Duration(nanosec=round(duration_s * 1e9))
    return request
