# SPDX-License-Identifier: Apache-2.0
"""Diagnostics of the parts of a node, once a second on the topic `diagnostics`."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from enum import Enum

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from humanoid_common.qos import STATE
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.time import Time

__all__ = ['Diagnostics', 'Level', 'PartStatus']

_PERIOD_S = 1.0


class Level(Enum):
    """Severity of a status."""

    OK = DiagnosticStatus.OK
    WARN = DiagnosticStatus.WARN
    ERROR = DiagnosticStatus.ERROR


@dataclass(frozen=True)
class PartStatus:
    """
    Status of a part of a node.

    Attributes
    ----------
    part
        Name of the part, such as `speech`.
    message
        Description of the status, as a few words or a sentence.
    level
        Severity of the status.
    values
        Further values, by name.

    """

    part: str
    message: str
    level: Level = Level.OK
    values: Mapping[str, object] = field(default_factory=dict)


class Diagnostics:
    """
    Publisher of the status of the parts of a node, timed by a steady clock.

    Parameters
    ----------
    node
        The node, whose name precedes that of each part.
    report
        Returns the status of each part.
    time_s
        Returns the time of the stamps in s; without it they are of the clock of the node.

    """

    def __init__(
        self,
        node: Node,
        report: Callable[[], Iterable[PartStatus]],
        time_s: Callable[[], float] | None = None,
    ) -> None:
        self._node, self._report, self._time_s = node, report, time_s
        self._publisher = node.create_publisher(DiagnosticArray, 'diagnostics', STATE)
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = node.create_timer(_PERIOD_S, self._publish, clock=steady)

    def _publish(self) -> None:
        name = self._node.get_fully_qualified_name().lstrip('/')
        message = DiagnosticArray(status=[_status(name, each) for each in self._report()])
        message.header.stamp = self._now().to_msg()
        self._publisher.publish(message)

    def _now(self) -> Time:
        if self._time_s is None:
            return self._node.get_clock().now()
        return Time(nanoseconds=round(self._time_s() * 1e9))


def _status(node: str, status: PartStatus) -> DiagnosticStatus:
    return DiagnosticStatus(
        name=f'{node}: {status.part}',
        level=status.level.value,
        message=status.message,
        values=[KeyValue(key=key, value=str(value)) for key, value in status.values.items()],
    )
