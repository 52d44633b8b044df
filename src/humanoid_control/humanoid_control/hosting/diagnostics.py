# SPDX-License-Identifier: Apache-2.0
"""Say how the robots of a node are, and how busy it is."""

from __future__ import annotations

from collections.abc import Callable, Mapping
import time

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from humanoid_common.qos import STATE
from humanoid_control.hosting.host import Host
from humanoid_control.hosting.hosted_robots import HostedRobots, RobotHealth
from humanoid_control.hosting.slowness import Slowness, Speed
from humanoid_control.hosting.topics.filling import fill_stamp
from rclpy.clock import Clock, ClockType
from rclpy.node import Node

PERIOD_S = 1.0


class HostDiagnostics:
    """The topic `diagnostics`, in the robots' time: the control loop, and each robot."""

    def __init__(
        self,
        node: Node,
        host: Host,
        robots: HostedRobots,
        speed: Callable[[], Speed | None] = lambda: None,
    ) -> None:
        """Begin to publish, once a second; `speed` is how fast the robots' time passes."""
        self._host, self._robots, self._speed = host, robots, speed
        self._slowness, self._has_complained = Slowness(), False
        self._logger = node.get_logger()
        self._name = node.get_fully_qualified_name().lstrip('/')
        self._publisher = node.create_publisher(DiagnosticArray, 'diagnostics', STATE)
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = node.create_timer(PERIOD_S, self._publish, clock=steady)

    def _publish(self) -> None:
        """Publish all statuses."""
        robots = [self._robot(*entry) for entry in self._robots.health().items()]
        message = DiagnosticArray(status=[self._loop(), *robots])
        fill_stamp(message.header.stamp, self._robots.time_s)
        self._publisher.publish(message)

    def _loop(self) -> DiagnosticStatus:
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
        return self._status(
            'control loop',
            DiagnosticStatus.WARN if complaint else DiagnosticStatus.OK,
            complaint or ('paused' if self._host.paused else 'runs'),
            values,
        )

    def _robot(self, robot: str, health: RobotHealth) -> DiagnosticStatus:
        """Return the status of a robot."""
        values = {'mode': health.mode, 'walk': health.walk, **health.lent}
        return self._status(robot or 'robot', *_verdict(health), values)

    def _status(
        self, part: str, level: bytes, message: str, values: Mapping[str, str]
    ) -> DiagnosticStatus:
        return DiagnosticStatus(
            name=f'{self._name}: {part}',
            hardware_id='',
            level=level,
            message=message,
            values=[KeyValue(key=key, value=value) for key, value in values.items()],
        )


def _verdict(health: RobotHealth) -> tuple[bytes, str]:
    """Return how bad it is, and what to say of it."""
    if health.trouble:
        return DiagnosticStatus.ERROR, health.trouble
    if health.holds_because:
        return DiagnosticStatus.WARN, f'holds still: {health.holds_because}'
    if health.is_blocked:
        return DiagnosticStatus.WARN, 'something is in the way, and it goes no further that way'
    return DiagnosticStatus.OK, health.mode
