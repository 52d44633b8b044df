# SPDX-License-Identifier: Apache-2.0
"""Diagnostics of the robots of a node, and of its load."""

from __future__ import annotations

from collections.abc import Callable
import time

from humanoid_common.diagnostics import Diagnostics, Level, PartStatus
from humanoid_control.hosting.host import Host
from humanoid_control.hosting.hosted_robots import HostedRobots, RobotHealth
from humanoid_control.hosting.slowness import Slowness, Speed
from rclpy.node import Node


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
        robots: HostedRobots,
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
                f'{complaint[:1].upper()}{complaint[1:]}, so that the world goes slower.'
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
        return Level.WARN, 'something is in the way, and it goes no further that way'
    return Level.OK, health.mode
