# SPDX-License-Identifier: Apache-2.0
"""Panel to drive a robot with an on-screen stick or keys."""

from __future__ import annotations

from geometry_msgs.msg import Twist, Vector3
from rclpy.duration import Duration
from robot_console.connections import Connections
from robot_console.drive_session import DriveSession
from robot_console.namespaces import NAMESPACE, topic_of_robot
from robot_console.robot_link import COMMAND, link_of
from robot_console.small_page import SmallPage
from robot_console.speed_limits import SpeedLimits, Velocity
from rviz_common.panel import Panel
from rviz_common.properties import Number, Topic

__all__ = ['Drive']

MOVES, TURNS = (0.0, 20.0), (0.0, 20.0)


class Drive(Panel):
    """Publishes the velocity that one person at a time wants, as long as that person holds it."""

    CLASS = 'robot_console/Drive'
    PROPERTIES = (
        NAMESPACE,
        Topic('Topic', 'cmd_vel', 'Where the velocity is published.', 'geometry_msgs/msg/Twist'),
        Number('Max Forward Speed', 0.5, 'In metres a second.', *MOVES),
        Number('Max Sideways Speed', 0.3, 'In metres a second; 0 without sidesteps.', *MOVES),
        Number('Max Turn Speed', 1.0, 'In radians a second.', *TURNS),
    )

    def start(self) -> None:
        """Create the velocity publisher, and add the page with the stick."""
        namespace, node = self.values['Namespace'], self.context.node
        self._link = link_of(self.context, namespace)
        self._limits = SpeedLimits(
            *(self.values[f'Max {way} Speed'] for way in ('Forward', 'Sideways', 'Turn'))
        )
        topic = topic_of_robot(node, namespace, self.values['Topic'])
        self._publisher = node.create_publisher(Twist, topic, COMMAND)
        settings = {
            'topic': topic,
            'forward': self._limits.forward_m_s,
            'sideways': self._limits.sideways_m_s,
            'turn': self._limits.turn_rad_s,
        }
        talks = Connections(self._link.people, self._session)
        self._page = SmallPage(self.context, 'drive', namespace, settings, talks)

    def close(self) -> None:
        """Remove the page, which stops a robot that is being driven."""
        self._page.close()
        self._publisher.wait_for_all_acked(Duration(seconds=0.2))
        self.context.node.destroy_publisher(self._publisher)

    def _session(self, person: str) -> DriveSession:
        count_listeners = self._publisher.get_subscription_count
        return DriveSession(self._link, person, self._limits, self._say, count_listeners)

    def _say(self, velocity: Velocity) -> None:
        """Publish a velocity command, in the thread of the connection."""
        twist = Twist(
            linear=Vector3(x=velocity.forward_m_s, y=velocity.left_m_s),
            angular=Vector3(z=velocity.turn_rad_s),
        )
        self._publisher.publish(twist)
