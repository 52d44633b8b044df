# SPDX-License-Identifier: Apache-2.0
"""The node that publishes the joint states of a robot: parameters, sources and publisher."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any, ClassVar

from joint_state_publisher.merged_joints import MergedJoints, States
from joint_state_publisher.settings import DESCRIPTIONS, MAPS, Settings, settings_of
from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from robot_state_publisher.node_arguments import (
    given_parameters,
    parameters_from_file,
    unknown_parameters,
)
from robot_state_publisher.state_watch import StateWatch
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from urdf import parse_urdf, RobotModel

__all__ = ['Extra', 'JointStatePublisher']

CHANGEABLE = ('robot_description', 'delta')
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
PATIENCE_S = 2.0
REPEAT_S = 10.0

# Best effort is compatible with reliable and best-effort publishers.
ANY = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
Take = Callable[[str, JointState], None]


@dataclass(frozen=True)
class Extra:
    """An additional, read-only parameter of a derived node."""

    default: Any
    description: str


class JointStatePublisher(Node):
    """
    Publishes the joint states of a robot: default values merged with those of source topics.

    Parameters
    ----------
    file
        A URDF file; by default, the URDF is read from the parameter or topic robot_description.

    Raises
    ------
    ValueError
        A parameter or the robot description is invalid.

    """

    EXTRAS: ClassVar[Mapping[str, Extra]] = {}
    """Additional parameters that a subclass declares."""

    def __init__(self, file: str | None = None) -> None:
        super().__init__('joint_state_publisher', parameter_overrides=parameters_from_file(file))
        self._settings = _declare_settings(self, self.EXTRAS)
        self._joints: MergedJoints | None = None
        self._watch: StateWatch | None = None
        self._publisher = self.create_publisher(JointState, 'joint_states', QoSProfile(depth=10))
        self._sources = _Sources(
            self, self._settings.source_list, self._publisher.topic_name, self._take
        )
        self._find_robot(file)
        self.create_timer(1.0 / self._settings.rate, self._publish)
        self._patience = self.create_timer(
            PATIENCE_S, self._on_patience_end, clock=Clock(clock_type=ClockType.STEADY_TIME)
        )
        self.add_on_set_parameters_callback(self._check)
        self.add_post_set_parameters_callback(self._swap)

    def _take(self, topic: str, message: JointState) -> None:
        """Merge the joint states received from a source topic."""
        if self._joints is None or self._watch is None:
            return
        for sentence in self._watch.misspelt(message.name):
            self.get_logger().warning(f'{topic}: {sentence}')
        states = States(message.name, message.position, message.velocity, message.effort)
        try:
            self._joints.take(states)
        except ValueError as error:
            self._left_out(f'{topic}: a message has {error}, and is ignored.')
            return
        if wrong := self._joints.not_finite(states):
            names = ', '.join(f"'{name}'" for name in wrong)
            self._left_out(f'{topic}: the position of {names} is not a number, and is ignored.')

    def _left_out(self, sentence: str) -> None:
        """Log a warning about rejected values, throttled because sources may repeat them."""
        self.get_logger().warning(sentence, throttle_duration_sec=REPEAT_S)

    def _refused(self, sentence: str) -> None:
        """Log why a robot description was rejected."""
        self.get_logger().error(sentence)

    def _find_robot(self, file: str | None) -> None:
        """Load the robot from the file or the parameter, or wait for it on the topic."""
        if self._settings.robot_description:
            self._load(self._settings, file or 'robot_description')
            return
        self.create_subscription(String, 'robot_description', self._on_description, LATCHED)
        topic = self.resolve_topic_name('robot_description')
        self.get_logger().info(
            f'Waiting for robot_description to be published on the {topic} topic...'
        )

    def _load(self, settings: Settings, source: str) -> None:
        """Load a robot; on ValueError, the previous robot remains in use."""
        model = parse_urdf(settings.robot_description, source)
        joints = MergedJoints(model, settings)
        self._settings = settings
        self._begin(model, joints)
        for sentence in joints.surplus_zeros(settings):
            self.get_logger().warning(sentence)

    def _begin(self, model: RobotModel, joints: MergedJoints) -> None:
        """Start publishing the joint states of a robot."""
        self._joints, self._watch = joints, StateWatch(model)
        self.get_logger().info(model.describe())

    def _on_description(self, message: String) -> None:
        """Load the robot description that was received, unless it is invalid."""
        try:
            self._load(self._changed({'robot_description': message.data}), 'robot_description')
        except ValueError as error:
            self._refused(f'A robot description is ignored. {error}')

    def _publish(self) -> None:
        """Publish the states of all joints, if any are known."""
        if self._joints is None:
            return
        if self._settings.delta:
            self._joints.move(self._settings.delta)
        states = self._joints.states()
        if not states.name:
            return
        message = JointState(**vars(states))
        message.header.stamp = self.get_clock().now().to_msg()
        self._publisher.publish(message)

    def _on_patience_end(self) -> None:
        """Report once which topics are still silent."""
        self._patience.cancel()
        self._report_silence([self._silence(topic) for topic in self._awaited()])

    def _awaited(self) -> list[str]:
        """Return the topics on which no message has been received yet."""
        awaited = sorted(self._sources.silent)
        if self._joints is None:
            awaited.append(self.resolve_topic_name('robot_description'))
        return awaited

    def _silence(self, topic: str) -> str:
        count = self.count_publishers(topic)
        found = '1 publisher was found' if count == 1 else f'{count} publishers were found'
        who = found if count else 'it has no publisher'
        return f'Nothing received on {topic} so far: {who}.'

    def _report_silence(self, sentences: list[str]) -> None:
        """Log warnings about topics that are still silent."""
        for sentence in sentences:
            self.get_logger().warning(sentence)

    def _check(self, changes: list[Parameter]) -> SetParametersResult:
        """Accept parameter changes only if all of them can be applied."""
        try:
            settings = self._changed(_values(changes))
            if settings.robot_description != self._settings.robot_description:
                MergedJoints(parse_urdf(settings.robot_description), settings)
        except ValueError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _swap(self, changes: list[Parameter]) -> None:
        """Apply accepted parameter changes."""
        settings = self._changed(_values(changes))
        if settings.robot_description != self._settings.robot_description:
            self._load(settings, 'robot_description')
        self._settings = settings

    def _changed(self, values: dict[str, Any]) -> Settings:
        """Return the settings with new values for the parameters that may change at run time."""
        new = settings_of(values)
        names = [name for name in CHANGEABLE if name in values]
        return replace(self._settings, **{name: getattr(new, name) for name in names})


def _values(changes: list[Parameter]) -> dict[str, Any]:
    return {change.name: change.value for change in changes}


class _Sources:
    """
    Subscriptions to the topics of `source_list`.

    Parameters
    ----------
    node
        The node that subscribes.
    names
        The topics, as given in the parameter.
    own_topic
        The fully qualified name of the topic on which the node itself publishes.
    take
        Called for each message with the fully qualified topic name and the message.

    Raises
    ------
    ValueError
        A name is not a valid topic name, or is that of the node's own topic.

    """

    def __init__(self, node: Node, names: Iterable[str], own_topic: str, take: Take) -> None:
        self._take = take
        self.silent: set[str] = set()
        """The topics on which no message has been received yet."""
        for name in names:
            topic = _resolved(node, name)
            if topic == own_topic:
                raise ValueError(
                    f"The parameter 'source_list' names {topic}, which is what this node "
                    'publishes. Name another topic, or remap joint_states.'
                )
            self.silent.add(topic)
            node.create_subscription(JointState, name, self._receiver(topic), ANY)

    def _receiver(self, topic: str) -> Callable[[JointState], None]:
        """Return the callback for the messages of a topic."""

        def receive(message: JointState) -> None:
            self.silent.discard(topic)
            self._take(topic, message)

        return receive


def _resolved(node: Node, name: str) -> str:
    """Return the fully qualified name of a topic, or raise ValueError if the name is invalid."""
    try:
        return str(node.resolve_topic_name(name))
    except RuntimeError as error:
        reason = str(error).split(', at ')[0].removeprefix('failed to resolve name: ')
        raise ValueError(
            f"The parameter 'source_list' names '{name}', which is not a valid topic: {reason}."
        ) from error


def _declare_settings(node: Node, extras: Mapping[str, Extra]) -> Settings:
    """
    Declare the parameters of the node, including those given for individual joints.

    rclpy has no public API for parameter overrides; parameters that it declares automatically have
    no description, and it does not accept an empty list.

    Parameters
    ----------
    node
        The node; it logs a warning for each unknown parameter.
    extras
        Additional parameters of a derived node, by name.

    Returns
    -------
    Settings
        The initial values, without those of `extras`.

    Raises
    ------
    ValueError
        A value is invalid.

    """
    descriptions = {
        **DESCRIPTIONS,
        **{name: extra.description for name, extra in extras.items()},
    }
    given = given_parameters(node)
    for sentence in unknown_parameters(given, descriptions, MAPS):
        node.get_logger().warning(sentence)
    settings = settings_of(given)
    defaults = {**vars(settings), **{name: extra.default for name, extra in extras.items()}}
    of_joints = [name for name in given if name.startswith(MAPS)]
    for name in (*descriptions, *of_joints):
        default = defaults.get(name, given.get(name))
        descriptor = ParameterDescriptor(
            description=descriptions.get(name, ''),
            read_only=name not in CHANGEABLE,
            dynamic_typing=True,
        )
        value = list(default) if isinstance(default, tuple) else default
        node.declare_parameter(name, value, descriptor)
    return settings
