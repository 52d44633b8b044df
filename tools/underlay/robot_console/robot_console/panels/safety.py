# SPDX-License-Identifier: Apache-2.0
"""Panel with the emergency stop, and whether the robot is real, listens and keeps up."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
import math
import time
from typing import Any

from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from robot_console.control import place_of
from robot_console.control_page import Connections, Session
from robot_console.namespaces import NAMESPACE
from robot_console.robot_link import link_of, node_names, RobotLink
from robot_console.small_page import SmallPage
from rviz_common.panel import Panel
from rviz_common.properties import Choice
from rviz_common.widget_order import ALWAYS_ORDER
from std_msgs.msg import Float64

__all__ = [
    'AUTO',
    'REAL',
    'SIMULATED',
    'UNKNOWN',
    'Facts',
    'RealTimeFactor',
    'Safety',
    'SafetySession',
    'robot_kind',
]

AUTO, REAL, SIMULATED, UNKNOWN = 'auto', 'real', 'simulated', 'unknown'
KINDS = (AUTO, REAL, SIMULATED)

TOPIC = 'real_time_factor'
STALE_S = 3.0
"""Simulators publish once a second; one that is silent for longer is paused or gone."""

NO_ROBOTS = ('_', 'rosbag2_')
PERIOD_S = 0.5


def robot_kind(told: str, clock_publishers: int) -> str:
    """
    Determine whether a robot is reported as real or simulated.

    Parameters
    ----------
    told
        One of `KINDS`; any value except `AUTO` is set by the user, and returned unchanged.
    clock_publishers
        The number of publishers of `/clock`; simulators publish it.

    Returns
    -------
    str
        `REAL`, `SIMULATED` or `UNKNOWN`; `AUTO` never results in `REAL`.

    """
    if told != AUTO:
        return told
    return SIMULATED if clock_publishers else UNKNOWN


class RealTimeFactor:
    """
    Subscribes to the real-time factor that a simulator publishes on `real_time_factor`.

    Parameters
    ----------
    node
        The node that subscribes; the topic is relative to its namespace.

    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._heard: tuple[float, float] | None = None
        newest = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
        self._subscription = node.create_subscription(Float64, TOPIC, self._hear, newest)

    def factor(self, now_s: float) -> float | None:
        """
        Return the current real-time factor.

        Parameters
        ----------
        now_s
            The current time, from `time.monotonic`.

        Returns
        -------
        float or None
            Simulated seconds per real second; None if no message was received for 3 s.

        """
        if self._heard is None or now_s - self._heard[0] > STALE_S:
            return None
        return self._heard[1]

    def close(self) -> None:
        """Destroy the subscription."""
        self._node.destroy_subscription(self._subscription)

    def _hear(self, message: Float64) -> None:
        if math.isfinite(message.data):
            self._heard = time.monotonic(), message.data


@dataclass(frozen=True)
class Facts:
    """Facts about a robot, for its page."""

    kind: str = UNKNOWN
    listeners: tuple[str, ...] = ()
    """The nodes that subscribe to the emergency stop."""
    speakers: tuple[str, ...] = ()
    """The other nodes that publish the emergency stop."""
    says: str | None = None
    """The reason why the robot holds still, empty if it moves; None if it does not report it."""
    pace: float | None = None
    """The real-time factor of the simulator; None if it is not published."""


class SafetySession(Session):
    """
    Presses and releases the emergency stop, takes and releases control.

    Parameters
    ----------
    link
        The link to the robot.
    person
        The user of the page, as shown to others.
    facts
        Returns the current facts about the robot.

    """

    def __init__(self, link: RobotLink, person: str, facts: Callable[[], Facts]) -> None:
        super().__init__(link, person)
        self._facts = facts

    @property
    def actions(self) -> Mapping[str, Callable[[Mapping[str, Any]], None]]:
        """Return the actions that the page may request."""
        return {
            'beat': lambda message: None,
            'stop': lambda message: self.link.say_stop(True, self.person),
            'release': self._release,
            'take': lambda message: self._take(),
            'give': lambda message: self.give(),
        }

    def state(self) -> dict[str, Any]:
        """Return the state that the page shows."""
        stop = self.link.stop
        return {
            **super().state(),
            'stop': asdict(stop),
            'stop_place': place_of(stop.by, self.person) if stop.by else '',
            **asdict(self._facts()),
        }

    def _release(self, message: Mapping[str, Any]) -> None:
        self.link.say_stop(False, self.person)
        self.link.control.lost = ''

    def _take(self) -> None:
        self.link.control.take(self.person, self)


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
            'Whether the robot is real; auto: simulated if /clock has a publisher.',
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
        listeners = node_names(node.get_subscriptions_info_by_topic(topic)) - {own}
        is_said = node.count_publishers(self._link.state_topic) > 0
        return Facts(
            robot_kind(self.values['Robot'], node.count_publishers('/clock')),
            tuple(sorted(filter(_may_be_robot, listeners))),
            tuple(sorted(self._link.stop_publishers())),
            self._link.holds_because if is_said else None,
            self._pace.factor(time.monotonic()),
        )


def _may_be_robot(name: str) -> bool:
    """Exclude hidden nodes and recorders, which do not react to an emergency stop."""
    return not name.rpartition('/')[2].startswith(NO_ROBOTS)
