# SPDX-License-Identifier: Apache-2.0
"""Panel to drive a robot with an on-screen stick or keys: speed limits, session, publisher."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
import math
from typing import Any, NamedTuple

from geometry_msgs.msg import Twist, Vector3
from rclpy.duration import Duration
from robot_console.control_page import Connections, Session
from robot_console.namespaces import NAMESPACE, topic_of_robot
from robot_console.robot_link import COMMAND, link_of, RobotLink
from robot_console.small_page import SmallPage
from rviz_common.panel import Panel
from rviz_common.properties import Number, Topic

__all__ = ['STILL', 'Drive', 'DriveSession', 'SpeedLimits', 'Velocity']

STOPPED = 'The emergency stop is pressed.'
STOP_ENDED = 'The emergency stop ended this.'
AGAIN = 'Let go, and press again.'

MOVES, TURNS = (0.0, 20.0), (0.0, 20.0)


class Velocity(NamedTuple):
    """Velocity of the base of a robot."""

    forward_m_s: float = 0.0
    left_m_s: float = 0.0
    turn_rad_s: float = 0.0


STILL = Velocity()


@dataclass(frozen=True)
class SpeedLimits:
    """Maximum speeds; zero for directions in which the robot cannot move."""

    forward_m_s: float
    sideways_m_s: float
    turn_rad_s: float

    def velocity(self, stick: Any, share: Any) -> Velocity:
        """
        Scale the deflection of the stick to a velocity of the base.

        Numbers outside their range are clamped.

        Parameters
        ----------
        stick
            Three numbers from -1 to 1: forward, left, and turn to the left.
        share
            Two numbers from 0 to 1: the fractions of the linear and of the angular speed limits
            that the user has selected.

        Returns
        -------
        Velocity
            In m/s and rad/s, in the base frame.

        Raises
        ------
        ValueError
            An argument is not a list of the required number of finite numbers.

        """
        forward, left, turn = _numbers(stick, 3, -1.0)
        move_share, turn_share = _numbers(share, 2, 0.0)
        return Velocity(
            forward * move_share * self.forward_m_s,
            left * move_share * self.sideways_m_s,
            turn * turn_share * self.turn_rad_s,
        )


def _numbers(given: Any, count: int, least: float) -> list[float]:
    """Validate numbers and clamp them to the range, or raise ValueError."""
    if not isinstance(given, list) or len(given) != count:
        raise ValueError(f'must be {count} numbers, not {given}')
    for each in given:
        is_number = isinstance(each, (int, float)) and not isinstance(each, bool)
        if not is_number or not -math.inf < each < math.inf:  # a large integer may not fit a float
            raise ValueError(f'must be finite numbers, not {given}')
    return [float(max(least, min(1.0, each))) for each in given]


class DriveSession(Session):
    """
    Drives a robot while a page repeats its request, which it does while the stick is held.

    Requests carry the number of their press. Once a press has ended, for whatever reason, its
    requests no longer move the robot.

    Parameters
    ----------
    link
        The link to the robot, with its emergency stop and its control arbitration.
    person
        The user of the page, as shown to others.
    limits
        The speeds at full deflection of the stick.
    say
        Publishes a velocity command of the base.
    count_listeners
        Returns the number of subscribers to the velocity command, which the page shows.

    """

    def __init__(
        self,
        link: RobotLink,
        person: str,
        limits: SpeedLimits,
        say: Callable[[Velocity], None],
        count_listeners: Callable[[], int],
    ) -> None:
        super().__init__(link, person)
        self._limits = limits
        self._say = say
        self._count_listeners = count_listeners
        self._velocity: Velocity | None = None
        self._press: Any = None
        self._ended: Any = None
        self._why_ended = ''
        self._is_lost = False
        self._refusal = ''

    @property
    def actions(self) -> Mapping[str, Callable[[Mapping[str, Any]], None]]:
        """Return the actions that the page may request."""
        return {'beat': self._rest, 'halt': self._rest, 'drive': self._drive}

    @property
    def is_watched(self) -> bool:
        """Whether the watchdog monitors the page."""
        return self._velocity is not None or super().is_watched

    def state(self) -> dict[str, Any]:
        """Return the state that the page shows."""
        velocity, refusal = self._velocity, self._refusal
        return {
            **super().state(),
            'velocity': velocity,
            'refusal': refusal,
            'listeners': self._count_listeners(),
            'holdsBecause': self.link.holds_because,
        }

    def lose(self) -> None:
        """Stop the robot, since the page is lost or its watchdog has expired."""
        self._is_lost |= self._velocity is not None
        self._stand_still()
        super().lose()

    def _drive(self, message: Mapping[str, Any]) -> None:
        velocity = self._limits.velocity(message.get('stick'), message.get('share'))
        self._press = message.get('press')
        if self._is_lost:
            self._is_lost, self._why_ended = False, stalled(self.silent_s)
        self._refusal = self._why_not()
        if self._refusal:
            self._stop()
        else:
            self._velocity = velocity
            self.link.mover = self
            self._say(velocity)

    def _why_not(self) -> str:
        """Take control, or return the reason why driving is rejected."""
        if self.link.stop.pressed:
            return STOPPED
        if self._ended is not None and self._press == self._ended:
            return f'{self._why_ended} {AGAIN}'.lstrip()
        if not self.link.control.take(self.person, self):
            return f'{self.link.control.person} is in control.'
        return ''

    def _rest(self, message: Mapping[str, Any]) -> None:
        self._refusal = STOPPED if self.link.stop.pressed else ''
        self._stop()

    def _stop(self) -> None:
        """Stop intentionally, and release control."""
        self._stand_still()
        self.give()

    def _stand_still(self) -> None:
        """End this press, and publish zero velocity if the robot was driven."""
        if self._velocity is not None:
            self._velocity = None
            self._ended = self._press
            self._why_ended = STOP_ENDED if self.link.stop.pressed else ''
            self._say(STILL)


def stalled(silent_s: float) -> str:
    """
    Explain to the user that the robot was stopped because the page stalled.

    Parameters
    ----------
    silent_s
        The time without a message from the page, in s.

    """
    return (
        f'The robot was stopped: this page stalled for {silent_s:.1f} s. '
        'This computer, or the network, is too busy.'
    )


class Drive(Panel):
    """Publishes the velocity that one person at a time wants, as long as that person holds it."""

    CLASS = 'robot_console/Drive'
    PROPERTIES = (
        NAMESPACE,
        Topic('Topic', 'cmd_vel', 'Where the velocity is published.', 'geometry_msgs/msg/Twist'),
        Number('Max Forward Speed', 0.5, 'In metres per second.', *MOVES),
        Number('Max Sideways Speed', 0.3, 'In metres per second; 0 without sidesteps.', *MOVES),
        Number('Max Turn Speed', 1.0, 'In radians per second.', *TURNS),
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
