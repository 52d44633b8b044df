# SPDX-License-Identifier: Apache-2.0
"""Diagnostics of a node: its robots, its load, and other publishers of its topics."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
import time
from typing import Protocol

from humanoid_common.diagnostics import Diagnostics, Level, PartStatus
from humanoid_control.hosting.host import Host
from rclpy.clock import Clock, ClockType
from rclpy.node import Node

SLOW_SHARE = 0.9
PATIENCE_S = 5.0
DUPLICATES_PERIOD_S = 3.0


@dataclass(frozen=True)
class RobotHealth:
    """Health of a robot."""

    mode: str
    walk: str
    trouble: str
    """The reason why the mode cannot work as it should; empty if it can."""
    is_blocked: bool
    """Whether something is in its way."""
    holds_because: str
    claimed: Mapping[str, str]
    """The joints that controllers have claimed from the mode, and these controllers."""


class MonitoredRobots(Protocol):
    """Robots of a node whose health is reported."""

    time_s: float
    """Time of the newest observation."""

    def health(self) -> Mapping[str, RobotHealth]:
        """Return the health of each robot, by name."""


class HostDiagnostics:
    """
    Publisher of `diagnostics`: the control loop, and each robot.

    It publishes once a second by a steady clock; the stamps are in the robots' time.

    Parameters
    ----------
    node
        The node that publishes it.
    host
        Runs the control loop, whose load is reported.
    robots
        The robots, whose health is reported.
    speed
        Returns the real-time factors; None while they are not known.

    """

    def __init__(
        self,
        node: Node,
        host: Host,
        robots: MonitoredRobots,
        speed: Callable[[], Speed | None] = lambda: None,
    ) -> None:
        self._host, self._robots, self._speed = host, robots, speed
        self._slowness, self._has_complained = Slowness(), False
        self._logger = node.get_logger()
        self._diagnostics = Diagnostics(node, self.report, lambda: robots.time_s)

    def report(self) -> list[PartStatus]:
        """Return the status of the control loop and of each robot."""
        robots = [_robot_status(*entry) for entry in self._robots.health().items()]
        return [self._loop(), *robots]

    def _loop(self) -> PartStatus:
        """Return the status of the control loop."""
        now_s = time.monotonic()
        load, speed = self._host.load.report(now_s), self._speed()
        complaint = self._slowness.complaint(speed, now_s)
        if complaint and not self._has_complained:
            self._has_complained = True
            self._logger.warning(
                f'{complaint[:1].upper()}{complaint[1:]}, so simulated time runs slower.'
            )
        values = {
            'ticks': f'{load.ticks}',
            'mean of a tick': f'{load.mean_ms:.2f} ms',
            'longest tick': f'{load.worst_ms:.2f} ms',
            'busy': f'{100.0 * load.share:.0f} %',
        }
        if speed is not None:
            values['real-time factor'] = f'{speed.reached:.2f}'
        return PartStatus(
            'control loop',
            complaint or ('paused' if self._host.paused else 'runs'),
            Level.WARN if complaint else Level.OK,
            values,
        )


def _robot_status(robot: str, health: RobotHealth) -> PartStatus:
    """Return the status of a robot."""
    level, message = _verdict(health)
    values = {'mode': health.mode, 'walk': health.walk, **health.claimed}
    return PartStatus(robot or 'robot', message, level, values)


def _verdict(health: RobotHealth) -> tuple[Level, str]:
    """Return the level and the message of the status of a robot."""
    if health.trouble:
        return Level.ERROR, health.trouble
    if health.holds_because:
        return Level.WARN, f'holds still: {health.holds_because}'
    if health.is_blocked:
        return Level.WARN, 'blocked: something is in the way'
    return Level.OK, health.mode


@dataclass(frozen=True)
class Speed:
    """Real-time factors: seconds of the robots' time per second of real time."""

    reached: float
    wanted: float
    """0 is as fast as possible: nothing is too slow then."""

    @property
    def is_slow(self) -> bool:
        """Whether less than 90 % of the wanted factor is reached."""
        return self.reached < SLOW_SHARE * self.wanted


class Slowness:
    """Detector of a computer that stays too busy, which ignores short delays."""

    def __init__(self) -> None:
        self._since_s: float | None = None

    def complaint(self, speed: Speed | None, now_s: float) -> str:
        """
        Return the message about a computer that is too busy; '' if it is not.

        Parameters
        ----------
        speed
            The real-time factors; None while they are not known, as in a pause.
        now_s
            Time of a steady clock.

        """
        if speed is None or not speed.is_slow:
            self._since_s = None
            return ''
        if self._since_s is None:
            self._since_s = now_s
        if now_s - self._since_s < PATIENCE_S:
            return ''
        return (
            f'slow: the real-time factor is {speed.reached:.2f} instead of {speed.wanted:g}. '
            'The computer is too busy'
        )


class DuplicatePublisherCheck:
    """
    Duplicate publisher check: warns of topics with another publisher, as from a second simulator.

    It checks every few seconds. A publisher must be seen twice in a row, as a node that ends may
    stay visible for a moment.

    Parameters
    ----------
    node
        The node that publishes the topics, and logs the warning.
    topics
        Topics that only this node may publish; names are relative to its namespace or absolute.

    """

    def __init__(self, node: Node, topics: Sequence[str]) -> None:
        self._node = node
        self._topics = tuple(node.resolve_topic_name(topic) for topic in topics)
        self._seen: set[str] = set()
        self._said: set[str] = set()
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = node.create_timer(DUPLICATES_PERIOD_S, self._look, clock=steady)

    def _look(self) -> None:
        """Warn of duplicates that persist, once for as long as they stay."""
        duplicates = {topic for topic in self._topics if self._node.count_publishers(topic) > 1}
        lasting = duplicates & self._seen
        if lasting - self._said:
            self._node.get_logger().warning(_duplicates_message(sorted(lasting - self._said)))
        self._seen, self._said = duplicates, lasting


def _duplicates_message(topics: Sequence[str]) -> str:
    """Build the warning about topics that have more than one publisher, given their names."""
    names = ', '.join(f"'{topic}'" for topic in topics)
    return (
        f'Another node also publishes {names}, so subscribers receive a mixture. Perhaps a second '
        'robot or simulator is running. Stop one of them, or give it its own namespace (a mock '
        'robot) or ROS_DOMAIN_ID (a simulator). A killed one stays visible for some 20 s.'
    )
