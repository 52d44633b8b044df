# SPDX-License-Identifier: Apache-2.0
"""The types of docks: where the robot waits, how it finds the dock, and when it is docked."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from geometry_msgs.msg import PoseStamped
from nav2_util.geometry import make_pose_stamped, Pose2D
from nav2_util.lifecycle_node import LifecycleNode
from nav2_util.parameters import parameter
import numpy as np
from rclpy.time import Time
from sensor_msgs.msg import BatteryState, JointState
from tf2_ros import TransformException

from opennav_docking.detection import docking_pose, PoseFilter, quaternion_of_angles

__all__ = ['DOCK_TYPES', 'DockParameters', 'SimpleChargingDock', 'SimpleNonChargingDock']

DOCK_TYPES = {
    'opennav_docking::SimpleChargingDock': 'opennav_docking.dock_types:SimpleChargingDock',
    'opennav_docking::SimpleNonChargingDock': 'opennav_docking.dock_types:SimpleNonChargingDock',
}
"""The import paths of dock types by their official names."""


@dataclass(frozen=True)
class DockParameters:
    """The parameters of a type of docks."""

    staging_x_offset: float = parameter(
        -0.7, 'Where the robot waits before the dock, along the heading of the dock, in m.'
    )
    staging_yaw_offset: float = parameter(0.0, 'Its yaw there, relative to the dock, in rad.')
    use_external_detection_pose: bool = parameter(
        False, "Whether a sensor detects the dock and publishes its pose on 'detected_dock_pose'."
    )
    external_detection_timeout: float = parameter(
        1.0, 'How old in s the detected pose may be.', low=0.0
    )
    external_detection_translation_x: float = parameter(
        -0.2, 'The docked robot before what is detected, along its heading, in m.'
    )
    external_detection_translation_y: float = parameter(0.0, 'The same to its left, in m.')
    external_detection_rotation_yaw: float = parameter(
        0.0, 'The rotation about z from the detected orientation to that of the dock, in rad.'
    )
    external_detection_rotation_pitch: float = parameter(1.57, 'The same about y, in rad.')
    external_detection_rotation_roll: float = parameter(-1.57, 'The same about x, in rad.')
    filter_coef: float = parameter(
        0.1, 'The weight of a new detection in the low-pass filter.', low=0.0, high=1.0
    )
    docking_threshold: float = parameter(
        0.05, 'The distance in m from the docking pose within which the robot is docked.', low=0.0
    )
    use_stall_detection: bool = parameter(
        False, 'Whether the robot is docked when its wheels stall, and not by its pose.'
    )
    stall_joint_names: list[str] = parameter([], "The joints in 'joint_states' that stall.")
    stall_velocity_threshold: float = parameter(
        1.0, 'The mean speed of those joints below which they stall.', low=0.0
    )
    stall_effort_threshold: float = parameter(
        1.0, 'The mean effort of those joints above which they stall.', low=0.0
    )


@dataclass(frozen=True)
class ChargingParameters:
    """The further parameters of docks that charge."""

    use_battery_status: bool = parameter(
        True, "Whether 'battery_state' says that it charges; otherwise it does when docked."
    )
    charging_threshold: float = parameter(
        0.5, 'The current of the battery in A above which it charges.'
    )


class SimpleNonChargingDock:
    """
    Dock at which nothing is charged, such as a conveyor belt.

    Parameters
    ----------
    node
        The docking server, which declares its parameters and subscribes.
    name
        The name of the type, the prefix of its parameters.
    fixed_frame
        The frame in which the robot moves smoothly.

    """

    is_charger = False

    def __init__(self, node: LifecycleNode, name: str, fixed_frame: str) -> None:
        self._node, self.name, self._frame = node, name, fixed_frame
        self._told = node.parameters.declare(DockParameters, name)
        told = self._told.current
        self._turn = quaternion_of_angles(
            told.external_detection_rotation_roll,
            told.external_detection_rotation_pitch,
            told.external_detection_rotation_yaw,
        )
        self._filter = PoseFilter(told.filter_coef, told.external_detection_timeout)
        self._detected: PoseStamped | None = None
        self._joints: dict[str, tuple[float, float]] = {}
        self._publisher = node.create_publisher(PoseStamped, 'dock_pose', 1)
        if told.use_external_detection_pose:
            node.create_subscription(PoseStamped, 'detected_dock_pose', self._on_detection, 1)
        if told.use_stall_detection:
            node.create_subscription(JointState, 'joint_states', self._on_joints, 1)

    def staging_pose(self, dock: Pose2D) -> Pose2D:
        """
        Return the pose at which the robot starts and ends docking.

        Parameters
        ----------
        dock
            The pose of the dock; the result is in the same frame.

        """
        told = self._told.current
        return dock @ Pose2D(told.staging_x_offset, 0.0, told.staging_yaw_offset)

    def refined_pose(self, dock: Pose2D) -> Pose2D | None:
        """
        Return the pose of the docked robot in the fixed frame.

        Parameters
        ----------
        dock
            The known pose of the dock in that frame.

        Returns
        -------
        Pose2D or None
            None if a sensor has to detect the dock, and has not, or not lately.

        """
        told = self._told.current
        if told.use_external_detection_pose:
            found = self._detection(told)
            if found is None:
                return None
            dock = found
        self._publisher.publish(
            make_pose_stamped(dock, self._frame, self._node.get_clock().now().to_msg())
        )
        return dock

    def is_docked(self, distance_m: float) -> bool:
        """
        Whether the robot is docked.

        Parameters
        ----------
        distance_m
            Its distance from the docking pose.

        """
        told = self._told.current
        if not told.use_stall_detection:
            return distance_m < told.docking_threshold
        found = [self._joints[name] for name in told.stall_joint_names if name in self._joints]
        if not found:
            return False
        speed, effort = np.abs(np.array(found)).mean(axis=0)
        return bool(speed < told.stall_velocity_threshold and effort > told.stall_effort_threshold)

    def is_charging(self, distance_m: float) -> bool:
        """
        Whether the robot is being charged.

        Parameters
        ----------
        distance_m
            Its distance from the docking pose.

        """
        return False

    def _detection(self, told: DockParameters) -> Pose2D | None:
        message, clock = self._detected, self._node.get_clock()
        if message is None:
            return None
        stamp = Time.from_msg(message.header.stamp, clock_type=clock.clock_type)
        if (clock.now() - stamp).nanoseconds * 1e-9 > told.external_detection_timeout:
            return None
        buffer, frame = self._node.transforms.buffer, message.header.frame_id
        try:
            try:
                found = buffer.lookup_transform(self._frame, frame, stamp)
            except TransformException:  # a transform of that time may still be on its way
                found = buffer.lookup_transform(self._frame, frame, Time())
        except TransformException as error:
            self._node.get_logger().warning(
                f'The detected pose of the dock cannot be used: {error}',
                throttle_duration_sec=2.0,
            )
            return None
        measured = docking_pose(
            message.pose,
            found.transform,
            self._turn,
            told.external_detection_translation_x,
            told.external_detection_translation_y,
        )
        return self._filter.update(measured, stamp.nanoseconds * 1e-9)

    def _on_detection(self, message: PoseStamped) -> None:
        self._detected = message

    def _on_joints(self, message: JointState) -> None:
        self._joints = {
            name: (velocity, effort)
            for name, velocity, effort in zip(message.name, message.velocity, message.effort)
        }


class SimpleChargingDock(SimpleNonChargingDock):
    """
    Dock that charges the battery of the robot.

    Parameters
    ----------
    node, name, fixed_frame
        As for `SimpleNonChargingDock`.

    """

    is_charger = True

    def __init__(self, node: LifecycleNode, name: str, fixed_frame: str) -> None:
        super().__init__(node, name, fixed_frame)
        self._charging = node.parameters.declare(ChargingParameters, name)
        self._current_a = 0.0
        if self._charging.current.use_battery_status:
            node.create_subscription(BatteryState, 'battery_state', self._on_battery, 1)

    def is_charging(self, distance_m: float) -> bool:
        """
        Whether the robot is being charged.

        Parameters
        ----------
        distance_m
            Its distance from the docking pose.

        """
        told = self._charging.current
        if told.use_battery_status:
            return self._current_a > told.charging_threshold
        return self.is_docked(distance_m)

    def _on_battery(self, message: Any) -> None:
        self._current_a = message.current
