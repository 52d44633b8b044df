# SPDX-License-Identifier: Apache-2.0
"""Display with a ghost of the robot at the commanded joint positions."""

from __future__ import annotations

from collections.abc import Sequence, Set
from dataclasses import replace
import time

from robot_console.commanded_joints import CommandedJoints, following_links, Tolerances
from robot_console.namespaces import below, NAMESPACE
from rviz_common.frames import Pose
from rviz_common.polled_topic import PolledTopic
from rviz_common.properties import ColorOf, Flag, Number, Property, qos_of, topic_properties
from rviz_common.selection import Hit, Ray
from rviz_common.status import Level
from rviz_default_plugins.displays.robot_model import RobotModel
from rviz_default_plugins.robot.robot_scene import Look, PoseOf, RobotScene
from urdf import Color, Joint
from urdf import RobotModel as Robot

__all__ = ['CommandedRobot']

COMMANDS = 'Command Topic'
OWN_COLOR = 'Use Color'
NEAR, ALIGNED = 'Position Tolerance', 'Angle Tolerance'
SHOWN = 'The ghost shows the links that lag behind their commands.'
FOLLOWING = 'All links follow their commands, so the ghost is hidden.'
MARGIN_M = 0.003
MAX_NAMES = 5
DEFAULTS = {
    'Alpha': 0.3,
    'Description Topic/Value': 'robot_description',
    'Command Topic/Reliability Policy': 'Best Effort',
}


def _with_default(each: Property) -> Property:
    """Return a property of the robot display with the default of the ghost."""
    return replace(each, default=DEFAULTS.get(each.path, each.default))


class CommandedRobot(RobotModel):
    """
    The robot as its joints were told to stand, at the place where it is.

    A link is shown while it lags behind its command; joints without a command count as measured.
    The ghost is hidden a second after the last command.
    """

    CLASS = 'robot_console/CommandedRobot'
    PROPERTIES = (
        NAMESPACE,
        *map(
            _with_default,
            topic_properties('sensor_msgs/msg/JointState', 'joint_commands', path=COMMANDS),
        ),
        Flag(OWN_COLOR, True, 'Show it in one colour instead of those of the description.'),
        ColorOf('Color', (77, 171, 247), 'The colour of the ghost.'),
        Number(
            NEAR,
            0.01,
            'A link is shown if it is this far from its commanded position, in metres; 0: always.',
            0.0,
        ),
        Number(
            ALIGNED,
            0.03,
            'A link is also shown if it is turned this far, in radians; 0: always.',
            0.0,
        ),
        *map(_with_default, RobotModel.PROPERTIES),
    )

    def start(self) -> None:
        """Request the description, and subscribe to the joint commands."""
        self._joints: CommandedJoints | None = None
        self._commands: PolledTopic | None = None
        self._poses_of: tuple[PoseOf, PoseOf] | None = None
        self._following: frozenset[str] = frozenset()
        super().start()
        self._hear(self.topic_of(COMMANDS))

    def stop(self) -> None:
        """Hide the ghost, and unsubscribe."""
        if self._commands is not None:
            self._commands.close()
        self._commands = None
        super().stop()

    def pick(self, ray: Ray) -> Hit | None:
        """
        Find nothing: a click meets the robot behind its ghost.

        Parameters
        ----------
        ray
            As for `Display.pick`.

        """
        return None

    def on_change(self, path: str) -> None:
        """
        Apply a changed property: resubscribe for another command topic, redraw otherwise.

        Parameters
        ----------
        path
            The path of the property.

        """
        if path == NAMESPACE.path or path.startswith(COMMANDS):
            self.stop()
            self.start()
        else:
            super().on_change(path)

    def topic_of(self, path: str) -> str:
        """
        Return the topic of a property, resolved in the namespace of the robot.

        Parameters
        ----------
        path
            The path of the property, without `/Value`.

        """
        return below(self.values['Namespace'], super().topic_of(path))

    def look(self) -> Look:
        """Return the appearance of the ghost: slightly larger than the robot, to avoid overlap."""
        color: Color | None = None
        if self.values[OWN_COLOR]:
            red, green, blue = (part / 255.0 for part in self.values['Color'])
            color = red, green, blue, 1.0
        return replace(super().look(), color=color, margin_m=MARGIN_M)

    def poses(self, model: Robot) -> tuple[Pose | None, PoseOf]:
        """
        Return the pose of the root link, and a function for the commanded pose of each joint.

        Parameters
        ----------
        model
            The robot that is shown.

        Returns
        -------
        tuple
            The pose of the root link in the fixed frame, None if it is unknown or nothing was
            commanded in the last second; and a function that returns the pose of a joint's child
            link in the frame of the parent link (m, quaternion w, x, y, z). Joints without a
            command have the pose from tf.

        """
        if self._joints is None or self._joints.model is not model:
            self._joints = CommandedJoints(model)
        self._obey(self._joints)
        told = self._joints.poses(time.time())
        if not told:
            self._poses_of = None
            return None, lambda joint: None
        root, measured = super().poses(model)

        def commanded(joint: Joint) -> Pose | None:
            return told.get(joint.name) or measured(joint)

        self._poses_of = commanded, measured
        return root, commanded

    def hidden_links(self, robot: RobotScene) -> Set[str]:
        """
        Return the links that are where they were commanded to be: the robot itself shows those.

        Parameters
        ----------
        robot
            As for `RobotModel.hidden_links`.

        """
        if self._poses_of is not None:
            tolerances = Tolerances(self.values[NEAR], self.values[ALIGNED])
            self._following = following_links(
                robot.model.root, robot.joints, self._poses_of, tolerances, self._following
            )
        return self._following

    def say_reasons(self, model: Robot, root: Pose | None, unknown: list[Joint]) -> None:
        """
        Report in the status of the display why the ghost, or a part of it, is not shown.

        Parameters
        ----------
        model
            The robot that is shown.
        root
            The pose of its root link in the fixed frame, None if it is not shown.
        unknown
            The joints whose pose is unknown.

        """
        joints = self._joints
        if joints is None or not joints.is_told(time.time()):
            self.say('Transform', '')
            level = Level.ERROR if self._refusal else Level.WARN
            self.say('Command', f'{self._without_command()} The ghost is hidden.', level)
            return
        is_shown = len(self._following) < len(model.links)
        self.say('Command', SHOWN if is_shown else FOLLOWING, Level.OK)
        self.say('Joints', _not_known(joints.unknown))
        super().say_reasons(model, root, unknown)

    def _hear(self, topic: str) -> None:
        from sensor_msgs.msg import JointState

        self._refusal = ''
        try:
            qos = qos_of(self.values, COMMANDS)
            self._commands = PolledTopic(self.context.node, JointState, topic, qos)
        except Exception as error:  # rclpy has no one exception for bad names
            self._refusal = f"'{topic}' cannot be subscribed: {error}"
            self.say('Command', self._refusal, Level.ERROR)

    def _obey(self, joints: CommandedJoints) -> None:
        """Apply the joint commands that were received."""
        if self._commands is None:
            return
        for message, time_s in self._commands.take():
            try:
                joints.take(message.name, message.position, time_s)
            except ValueError as error:
                self.say('Message', f'A command was ignored: {error}')
            else:
                self.status.forget('Message')

    def _without_command(self) -> str:
        """Format the message why there is no command: none received, or no publisher."""
        if self._refusal:
            return f'{self._refusal}.'
        node = self.context.node
        topic = node.resolve_topic_name(self.topic_of(COMMANDS))
        if node.count_publishers(topic):
            return f'No positions received on {topic} for a second.'
        return f'No publisher on {topic}.'


def _not_known(names: Sequence[str]) -> str:
    """Format a warning that names joints of a command that the robot does not have."""
    if not names:
        return ''
    more = f' and {len(names) - MAX_NAMES} more' if len(names) > MAX_NAMES else ''
    return f'The description has no joint {", ".join(names[:MAX_NAMES])}{more}.'
