# SPDX-License-Identifier: Apache-2.0
"""Whether a robot can make gestures now: its joints, its controllers, its walk and its stop."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rclpy.qos import QoSProfile, ReliabilityPolicy
from robot_console.gestures.controllers import TrajectoryControllers
from robot_console.gestures.gesture_file import GestureError
from robot_console.gestures.gesture_plan import RobotState
from robot_console.namespaces import topic_of_robot
from robot_console.robot_link import LATCHED, RobotLink
from robot_console.state_words import WALKING
from rviz_common.polled_topic import PolledTopic
from rviz_default_plugins.robot.description import DescriptionTopic
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from urdf import Joint, parse_urdf, UrdfError

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['RobotWatch', 'why_not']

STANDING = 'stand'
STOPPED = 'The emergency stop is pressed. Release it first.'
NO_ROBOT = 'The robot is not known: there is no robot description yet.'
NEWEST = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)


def why_not(walking: str, is_stopped: bool, holds_because: str) -> str:
    """
    Explain why a robot cannot make a gesture now; '' if it can.

    Parameters
    ----------
    walking
        The walking state; '' if no node publishes it.
    is_stopped
        Whether the emergency stop is pressed.
    holds_because
        Why the robot holds still, as it reports; '' if it moves or does not report it.

    """
    if is_stopped:
        return STOPPED
    if holds_because:
        return f'The robot holds still: {holds_because}.'
    state = WALKING.get(walking)
    return f'{state.reason}. {state.advice}'.rstrip() if state and state.reason else ''


class RobotWatch:
    """
    What gestures need to know of a robot.

    Parameters
    ----------
    node, link, namespace
        The node that subscribes, the link to the robot, and its namespace.
    manager, joint_states, description
        The full names of the controller manager and of the topics.

    Attributes
    ----------
    controllers
        The trajectory controllers of the robot.
    name
        The name of the robot in its description; '' if it is not known.

    """

    def __init__(
        self,
        node: Node,
        link: RobotLink,
        namespace: str,
        manager: str,
        joint_states: str,
        description: str,
    ) -> None:
        self._node, self._link = node, link
        self._topic = topic_of_robot(node, namespace, 'walking_state')
        self.controllers = TrajectoryControllers(node, manager)
        self.name = self._walking = self._trouble = ''
        self._joints: dict[str, Joint] = {}
        self._positions: dict[str, float] = {}
        self._holds = False
        self._states = PolledTopic(node, JointState, joint_states, NEWEST)
        self._states.rest()
        self._description = DescriptionTopic(node, description, self._describe)
        self._subscription = node.create_subscription(
            String, self._topic, self._take_walking, LATCHED
        )

    @property
    def unready_because(self) -> str:
        """Return why no joint should be moved now, as a sentence; '' if nothing is known."""
        holds_because = self._link.holds_because if self._holds else ''
        return why_not(self._walking, self._link.stop.pressed, holds_because)

    @property
    def problem(self) -> str:
        """Return why no gesture is possible, as a sentence; '' if some may be."""
        if self.unready_because:
            return self.unready_because
        if not self.controllers.joints:
            return self.controllers.problem
        return self._trouble or ('' if self._joints else NO_ROBOT)

    def state(self, bends: bool) -> RobotState:
        """
        Return the state of the robot, from which a gesture can be planned.

        Parameters
        ----------
        bends
            Whether the gesture also commands the body pose.

        Raises
        ------
        GestureError
            No such gesture is possible; the message is a full sentence.

        """
        if self.problem:
            raise GestureError(self.problem)
        if bends and self._walking not in ('', STANDING):
            raise GestureError(f"The robot does not balance: its mode is '{self._walking}'.")
        return RobotState(self._joints, self.controllers.joints, self._positions)

    def posture(self) -> dict[str, float]:
        """Return the positions of the joints that controllers move."""
        own = (joint for joints in self.controllers.joints.values() for joint in joints)
        return {
            joint: round(self._positions[joint], 4) for joint in own if joint in self._positions
        }

    def update(self) -> None:
        """Follow the joints and the controllers; call it often while somebody watches."""
        self._states.resume()
        for message, _ in self._states.take():
            self._positions.update(zip(message.name, message.position))
        self.controllers.update()

    def rest(self) -> None:
        """Follow the joints and the controllers no longer, until `update`."""
        self._states.rest()
        self._positions.clear()
        self.controllers.close()

    def examine(self) -> None:
        """Find out which states are still published; call it about once a second."""
        if not self._node.count_publishers(self._topic):
            self._walking = ''
        self._holds = self._node.count_publishers(self._link.state_topic) > 0

    def close(self) -> None:
        """Destroy the subscriptions and the client."""
        self.controllers.close()
        self._states.close()
        self._description.close()
        self._node.destroy_subscription(self._subscription)

    def _describe(self, text: str, source: str) -> None:
        """Take the joints and the name of the robot."""
        try:
            model = parse_urdf(text, source)
        except UrdfError as error:
            self._trouble = str(error)
            return
        self._trouble = ''
        self._joints = {joint.name: joint for joint in model.moving_joints}
        self.name = model.name

    def _take_walking(self, message: String) -> None:
        self._walking = message.data
