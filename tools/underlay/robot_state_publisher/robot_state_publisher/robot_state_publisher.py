# SPDX-License-Identifier: Apache-2.0
"""The node that publishes the transforms of the links of a robot."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult
from rclpy.clock import Clock, ClockType, JumpThreshold, TimeJump
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, qos_profile_sensor_data, QoSProfile
from robot_state_publisher.moving_links import UnusableStateError, usable_positions
from robot_state_publisher.node_arguments import (
    given_parameters,
    parameters_from_file,
    unknown_parameters,
)
from robot_state_publisher.published_robot import PublishedRobot
from robot_state_publisher.settings import DESCRIPTIONS, Settings
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage
from urdf import RobotModel

__all__ = ['RobotStatePublisher']

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
PATIENCE_S = 5.0
REPEAT_S = 10.0
JUMPS_S = 60.0
"""Log interval for time jumps; two simulators in a domain cause one with every /clock message."""
TIME_JUMPED = (
    'Time has jumped back: all joints are published again. If this keeps happening, two '
    'simulators publish /clock.'
)


class RobotStatePublisher(Node):
    """
    Publishes the robot description, its static transforms, and those of moving joints.

    Parameters
    ----------
    file
        A URDF file; by default, the URDF is read from the parameter robot_description.

    Raises
    ------
    ValueError
        There is no robot description, or a parameter is invalid.

    """

    def __init__(self, file: str | None = None) -> None:
        super().__init__('robot_state_publisher', parameter_overrides=parameters_from_file(file))
        self._settings = _declare(self)
        _warn_of_unknown(self)
        self._robot = PublishedRobot(self._first_model(file), self._settings)
        self._description = self.create_publisher(String, 'robot_description', LATCHED)
        self._tf_static = self.create_publisher(TFMessage, '/tf_static', LATCHED)
        self._tf = self.create_publisher(TFMessage, '/tf', QoSProfile(depth=100))
        self._states = self.create_subscription(
            JointState, 'joint_states', self._on_joint_state, qos_profile_sensor_data
        )
        self._patience = self.create_timer(
            PATIENCE_S, self._on_patience_end, clock=Clock(clock_type=ClockType.STEADY_TIME)
        )
        self._jumps = self.get_clock().create_jump_callback(
            JumpThreshold(
                min_forward=None, min_backward=Duration(nanoseconds=-1), on_clock_change=False
            ),
            post_callback=self._on_time_jump,
        )
        self.add_on_set_parameters_callback(self._check)
        self.add_post_set_parameters_callback(self._swap)
        self._publish_robot()

    def _first_model(self, file: str | None) -> RobotModel:
        """Return the initial robot model, or raise ValueError."""
        if not self._settings.robot_description.strip() and file is None:
            raise ValueError(
                "Node 'robot_state_publisher' needs the parameter robot_description, the text of "
                "a URDF. In a launch file: parameters=[{'robot_description': "
                """ParameterValue(Command(['xacro "', path, '"']), value_type=str)}]."""
            )
        return self._settings.model(file or 'robot_description')

    def _publish_robot(self) -> None:
        """Publish the description and static transforms, and start to wait for joint states."""
        robot, logger = self._robot, self.get_logger()
        logger.info(robot.model.describe())
        for joint in robot.model.joints:
            if joint.kind == 'floating':
                logger.info(f"Joint '{joint.name}' is floating: its transform is not published.")
            elif joint.kind == 'planar':
                logger.warning(f"Joint '{joint.name}' is planar, and published as if fixed.")
        self._description.publish(String(data=self._settings.robot_description))
        self._tf_static.publish(robot.fixed_transforms(self.get_clock().now().to_msg()))
        self._patience.reset()

    def _on_joint_state(self, message: JointState) -> None:
        """Publish the transforms of the joints in the message."""
        try:
            transforms = self._transforms(message)
        except UnusableStateError as reason:
            self.get_logger().warning(str(reason), throttle_duration_sec=REPEAT_S)
            return
        if transforms is not None:
            self._tf.publish(transforms)

    def _transforms(self, message: JointState) -> TFMessage | None:
        """Compute the transforms that are due, or raise UnusableStateError."""
        names, positions = usable_positions(message.name, message.position)
        self._robot.require_stamp(message.header.stamp)
        if len(names) < len(message.name):
            self._warn(self._robot.watch.unknown(set(message.name).difference(names)))
        if not self._robot.knows(names):
            self._tell_about(names)
        self._notice_time(message, names)
        return self._robot.transforms(names, positions, message.header.stamp)

    def _tell_about(self, names: Sequence[str]) -> None:
        """Log misspelt names in a new list of names, and whether all joints have a state now."""
        watch = self._robot.watch
        self._warn(watch.misspelt(names))
        relief = watch.relief()
        if relief:
            self.get_logger().info(relief)

    def _warn(self, sentences: Iterable[str]) -> None:
        for sentence in sentences:
            self.get_logger().warning(sentence)

    def _notice_time(self, message: JointState, names: Sequence[str]) -> None:
        """Reset the rate limit if stamps have jumped back, and log it."""
        notice = self._robot.notice_time(names, message.header.stamp)
        if notice:
            self.get_logger().warning(notice, throttle_duration_sec=REPEAT_S)

    def _on_patience_end(self) -> None:
        """Log the joints without a state, once per robot description."""
        self._patience.cancel()
        topic = self._states.topic_name
        complaint = self._robot.watch.complaint(self.count_publishers(topic), topic)
        if complaint:
            self.get_logger().warning(complaint)

    def _on_time_jump(self, jump: TimeJump) -> None:
        """Reset the rate limit when simulation time has jumped back."""
        self._robot.times.forget()
        self.get_logger().warning(TIME_JUMPED, throttle_duration_sec=JUMPS_S)

    def _check(self, changes: list[Parameter]) -> SetParametersResult:
        """Accept parameter changes only if the resulting robot can be published."""
        try:
            self._settings.changed(_values(changes)).model()
        except ValueError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _swap(self, changes: list[Parameter]) -> None:
        """Apply accepted parameter changes."""
        settings = self._settings.changed(_values(changes))
        if settings != self._settings:
            self._settings = settings
            self._robot = PublishedRobot(settings.model(), settings)
            self._publish_robot()


def _declare(node: Node) -> Settings:
    """Declare the parameters and return their initial values."""
    settings = Settings()
    for name, text in DESCRIPTIONS.items():
        # A frequency may be given as an integer.
        descriptor = ParameterDescriptor(
            description=text, dynamic_typing=name == 'publish_frequency'
        )
        node.declare_parameter(name, getattr(settings, name), descriptor)
    return settings.changed({name: node.get_parameter(name).value for name in DESCRIPTIONS})


def _warn_of_unknown(node: Node) -> None:
    """Log the parameters that were given but are unknown."""
    for sentence in unknown_parameters(given_parameters(node), DESCRIPTIONS):
        node.get_logger().warning(sentence)


def _values(changes: list[Parameter]) -> dict[str, Any]:
    return {change.name: change.value for change in changes}
