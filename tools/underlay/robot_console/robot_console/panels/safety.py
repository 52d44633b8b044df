# SPDX-License-Identifier: Apache-2.0
"""Panel with the emergency stop and the state relevant to safety."""

from __future__ import annotations

from collections.abc import Iterable
import time
from typing import Any

from robot_console.connections import Connections
from robot_console.namespaces import NAMESPACE
from robot_console.real_time_factor import RealTimeFactor
from robot_console.robot_kind import AUTO, KINDS, robot_kind
from robot_console.robot_link import link_of
from robot_console.safety_session import Facts, SafetySession
from robot_console.small_page import SmallPage
from rviz_common.panel import Panel
from rviz_common.panels.order import ALWAYS_ORDER
from rviz_common.properties import Choice

__all__ = ['Safety']

NO_ROBOTS = ('_', 'rosbag2_')
PERIOD_S = 0.5


class Safety(Panel):
    """
    A button that stops the robot, whether it hears that, whether it is real, who is in control.

    A press is published in the thread of the connection, even while the page is busy.
    """

    CLASS = 'robot_console/Safety'
    IS_ALWAYS_VISIBLE = True
    PROPERTIES = (
        NAMESPACE,
        Choice(
            'Robot',
            AUTO,
            'Whether the robot is real; auto: simulated if somebody publishes /clock.',
            KINDS,
        ),
    )

    def start(self) -> None:
        """Add the page with the button."""
        namespace, node = self.values['Namespace'], self.context.node
        self._link = link_of(self.context, namespace)
        self._facts = Facts()
        self._pace = RealTimeFactor(node)
        self._heard = ''
        self._looked_s = -PERIOD_S
        settings = {
            'domain': node.context.get_domain_id(),
            'topic': node.resolve_topic_name(self._link.stop_topic),
            'namespace': namespace,
        }
        talks = Connections(self._link.people, self._session)
        self._page = SmallPage(self.context, 'safety', namespace, settings, talks, ALWAYS_ORDER)

    def update(self) -> None:
        """Update the facts periodically, and at once when the robot has published its state."""
        now_s, heard = time.monotonic(), self._link.holds_because
        if now_s - self._looked_s >= PERIOD_S or heard != self._heard:
            self._looked_s, self._heard = now_s, heard
            self._facts = self._look()

    def close(self) -> None:
        """Remove the page; the robot detects it if this console was in control."""
        self._page.close()
        self._pace.close()

    def _session(self, person: str) -> SafetySession:
        return SafetySession(self._link, person, lambda: self._facts)

    def _look(self) -> Facts:
        """Collect the facts about the robot from the ROS graph."""
        node, topic = self.context.node, self._link.stop_topic
        own = node.get_fully_qualified_name()
        speakers = _names(node.get_publishers_info_by_topic(topic)) - {own}
        listeners = _names(node.get_subscriptions_info_by_topic(topic)) - {own}
        is_said = node.count_publishers(self._link.state_topic) > 0
        return Facts(
            robot_kind(self.values['Robot'], node.count_publishers('/clock')),
            tuple(sorted(filter(_may_be_robot, listeners))),
            tuple(sorted(speakers)),
            self._link.holds_because if is_said else None,
            self._pace.factor(time.monotonic()),
        )


def _names(ends: Iterable[Any]) -> set[str]:
    return {f'{end.node_namespace.rstrip("/")}/{end.node_name}' for end in ends}


def _may_be_robot(name: str) -> bool:
    """Exclude hidden nodes and recorders, which do not react to an emergency stop."""
    return not name.rpartition('/')[2].startswith(NO_ROBOTS)
