# SPDX-License-Identifier: Apache-2.0
"""Publisher of the transform from `odom` to `world`."""

from __future__ import annotations

import math

from geometry_msgs.msg import TransformStamped
from humanoid_common.qos import STATE
from humanoid_control.hosting.topics.filling import fill_quaternion, fill_stamp, fill_vector, topic
from humanoid_control.hosting.topics.odometry import ODOM
from humanoid_control.walking.odometry import Odometry
from humanoid_simulation.backend import EntityState
from humanoid_simulation.rotations import from_rpy, inverse, product
from humanoid_simulation.topics.ground_truth import WORLD
import numpy as np
from rclpy.node import Node
from tf2_msgs.msg import TFMessage

_LEAST_M, _LEAST_HEIGHT_M, _LEAST_RAD = 0.005, 0.02, 0.005


class WorldFrame:
    """
    Publisher of the true transform from `odom` to `world`, for viewers; no robot could know it.

    Like the odometry, it is a rotation about the vertical and a translation. It is repeated
    unchanged until the odometry is visibly off, so that a viewer need not move the whole world at
    each step.

    Parameters
    ----------
    node
        The node that publishes it.
    robot
        Namespace of the robot, relative to that of the node; '' if it is alone.
    prefix
        Prefix of the frame `odom`.

    """

    def __init__(self, node: Node, robot: str, prefix: str) -> None:
        self._transform = TransformStamped(child_frame_id=WORLD)
        self._transform.header.frame_id = prefix + ODOM
        self._message = TFMessage(transforms=[self._transform])
        self._publisher = node.create_publisher(TFMessage, topic(robot, 'tf'), STATE)
        self._at = math.inf, math.inf, math.inf, math.inf

    def publish(self, time_s: float, odometry: Odometry, truth: EntityState, age_s: float) -> None:
        """
        Publish the transform from `odom` to `world`, updated if it is visibly off.

        Parameters
        ----------
        time_s
            Simulated time of the odometry, for the stamp.
        odometry
            Where the robot believes it is.
        truth
            True state of its base, in the world frame.
        age_s
            How much older the odometry is than the truth.

        """
        x, y, z, yaw_rad = world_in_odom(odometry, truth, age_s)
        old_x, old_y, old_z, old_yaw_rad = self._at
        turned_rad = math.remainder(yaw_rad - old_yaw_rad, math.tau) if self._is_set else math.inf
        if (
            math.hypot(x - old_x, y - old_y) > _LEAST_M
            or abs(z - old_z) > _LEAST_HEIGHT_M
            or abs(turned_rad) > _LEAST_RAD
        ):
            self._at = x, y, z, yaw_rad
            fill_vector(self._transform.transform.translation, np.array([x, y, z]))
            fill_quaternion(self._transform.transform.rotation, from_rpy(0.0, 0.0, yaw_rad))
        fill_stamp(self._transform.header.stamp, time_s)
        self._publisher.publish(self._message)

    @property
    def _is_set(self) -> bool:
        """Whether there is a previous transform to compare with."""
        return math.isfinite(self._at[3])


def world_in_odom(
    odometry: Odometry, truth: EntityState, age_s: float = 0.0
) -> tuple[float, float, float, float]:
    """
    Compute the planar pose and the height of the world frame in `odom`.

    Parameters
    ----------
    odometry
        Where the robot believes it is, in `odom`.
    truth
        True state of its base, in the world frame.
    age_s
        How much older the odometry is; the true position is extrapolated back by it.

    Returns
    -------
    tuple[float, float, float, float]
        x, y and z in m, and the yaw in rad.

    """
    turn = product(np.array(odometry.orientation), inverse(truth.orientation))
    yaw_rad = math.atan2(
        2.0 * (turn[0] * turn[3] + turn[1] * turn[2]),
        1.0 - 2.0 * (turn[2] * turn[2] + turn[3] * turn[3]),
    )
    x, y, z = truth.position_m - age_s * truth.linear_velocity_m_s
    cosine, sine = math.cos(yaw_rad), math.sin(yaw_rad)
    believed_m = odometry.pose.position_m
    return (
        believed_m.real - (cosine * x - sine * y),
        believed_m.imag - (sine * x + cosine * y),
        odometry.height_m - z,
        yaw_rad,
    )
