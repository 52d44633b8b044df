# SPDX-License-Identifier: Apache-2.0
"""Panel with the joints of a robot: measured and commanded states and their limits."""

from __future__ import annotations

import time

from robot_console.joints.joint_html import notes_html, STYLE, table_html
from robot_console.joints.joint_state import JointStates
from robot_console.joints.joint_table import JointTable
from robot_console.joints.topic_sentence import TopicWatch
from robot_console.namespaces import NAMESPACE, topic_of_robot
from rviz_common.pace import Pace
from rviz_common.panel import Panel
from rviz_common.polled_topic import PolledTopic
from rviz_common.properties import Topic
from rviz_default_plugins.robot.description import DescriptionTopic
from urdf import parse_urdf, UrdfError

__all__ = ['JointsPanel']

PERIOD_S = 0.2
DEPTH = 100
DESCRIPTION, MEASURED, COMMANDED = 'Description Topic', 'Joint States Topic', 'Commands Topic'
JOINT_STATE = 'sensor_msgs/msg/JointState'


class JointsPanel(Panel):
    """A table of joints: position, error, velocity and effort, beside their limits."""

    CLASS = 'robot_console/Joints'
    PROPERTIES = (
        NAMESPACE,
        Topic(MEASURED, 'joint_states', 'What the joints do.', JOINT_STATE),
        Topic(COMMANDED, 'joint_commands', 'What the joints were told.', JOINT_STATE),
        Topic(DESCRIPTION, 'robot_description', 'What the joints can.', 'std_msgs/msg/String'),
    )

    def start(self) -> None:
        """Add the widgets, and subscribe to the topics."""
        self._table = JointTable()
        self._pace = Pace(PERIOD_S)
        self._topics: list[tuple[PolledTopic, JointStates]] = []
        self._trouble = ''
        gui = self.context.gui
        gui.add_html(STYLE)
        self._search = gui.add_text('Search', '', hint='A part of a name, such as left or knee')
        self.context.on_input(self._search, lambda text: self._pace.hurry())
        self._notes = gui.add_html('')
        self._rows = gui.add_html('')
        self._watches: list[TopicWatch] = []
        self._description: DescriptionTopic | None = None
        try:
            self._listen_all()
        except ValueError as error:
            self._trouble = f'A topic of the panel cannot be subscribed: {error}'

    def update(self) -> None:
        """Update the table if any browser is connected."""
        if not self._pace.is_due() or not self.context.server.get_clients():
            return
        self._take()
        now_s = time.time()
        search = self._search.value
        rows = table_html(self._table.groups(now_s, search))
        found = [] if rows or not search else [(f"No joint has '{search}' in its name.", True)]
        self._notes.content = notes_html([*self._said(now_s), *found])
        self._rows.content = rows

    def close(self) -> None:
        """Destroy the subscriptions."""
        if self._description is not None:
            self._description.close()
        for topic, _ in self._topics:
            topic.close()

    def _topic(self, path: str) -> str:
        return topic_of_robot(self.context.node, self.values['Namespace'], self.values[path])

    def _listen_all(self) -> None:
        for path, states in ((MEASURED, self._table.measured), (COMMANDED, self._table.commanded)):
            self._watches.append(self._listen(self._topic(path), states))
        self._description = DescriptionTopic(
            self.context.node, self._topic(DESCRIPTION), self._describe
        )

    def _listen(self, topic: str, states: JointStates) -> TopicWatch:
        from rclpy.qos import QoSProfile, ReliabilityPolicy
        from sensor_msgs.msg import JointState

        node = self.context.node
        qos = QoSProfile(depth=DEPTH, reliability=ReliabilityPolicy.BEST_EFFORT)
        self._topics.append((PolledTopic(node, JointState, topic, qos), states))
        return TopicWatch(topic, states)

    def _take(self) -> None:
        for topic, states in self._topics:
            for message, time_s in topic.take():
                states.take(
                    message.name, message.position, message.velocity, message.effort, time_s
                )

    def _describe(self, text: str, source: str) -> None:
        try:
            self._table.describe(parse_urdf(text, source))
        except UrdfError as error:
            self._trouble = str(error)
        else:
            self._trouble = ''

    def _said(self, now_s: float) -> list[tuple[str, bool]]:
        """Return the status messages, each with whether it is a warning."""
        node = self.context.node
        said = []
        for watch in self._watches:
            is_late = watch.is_late(now_s)
            publishers = node.count_publishers(watch.topic) if is_late else 1
            said.append((watch.sentence(now_s, publishers), is_late))
        said += [(each.complaint, True) for each in self._states() if each.complaint]
        if self._trouble:
            said.append((self._trouble, True))
        elif not self._table.is_described:
            said.append((f'No limits: no description on {self._topic(DESCRIPTION)} yet.', True))
        return said

    def _states(self) -> tuple[JointStates, JointStates]:
        return self._table.measured, self._table.commanded
