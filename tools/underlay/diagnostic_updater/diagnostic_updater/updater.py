# SPDX-License-Identifier: Apache-2.0
"""The publisher of diagnostics, which runs the tasks of a node periodically."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from diagnostic_updater.status_wrapper import DiagnosticStatusWrapper, level_of
from diagnostic_updater.tasks import DiagnosticTaskVector, FunctionDiagnosticTask
from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult
from rclpy.duration import Duration

__all__ = ['Updater']

_PERIOD = 'diagnostic_updater.period'


class Updater(DiagnosticTaskVector):
    """
    Runs the diagnostic tasks of a node periodically, and publishes on `/diagnostics`.

    The parameter `diagnostic_updater.period` of the node sets the period, also while it runs.

    Parameters
    ----------
    node
        The node, which must spin.
    period
        The period in s, if the parameter is not set.

    """

    def __init__(self, node: Any, period: float = 1.0) -> None:
        super().__init__()
        self.node = node
        self.verbose = False
        self.hwid = ''
        self._warned_of_hardware = False
        self.publisher = node.create_publisher(DiagnosticArray, '/diagnostics', 1)
        self.period = self._declare_period(float(period))
        self._last = node.get_clock().now()
        self._timer = node.create_timer(self.period, self.force_update)
        node.add_on_set_parameters_callback(self._check_period)
        node.add_post_set_parameters_callback(self._change_period)

    def _declare_period(self, period: float) -> float:
        if self.node.has_parameter(_PERIOD):
            return float(self.node.get_parameter(_PERIOD).value)
        described = ParameterDescriptor(description='Period of the diagnostics, in s.')
        declared = float(self.node.declare_parameter(_PERIOD, period, described).value)
        if declared <= 0.0:
            raise ValueError(f'The parameter {_PERIOD} is {declared}, but must be greater than 0')
        return declared

    def _check_period(self, parameters: Iterable[Any]) -> SetParametersResult:
        for each in parameters:
            if each.name == _PERIOD and (each.value or 0.0) <= 0.0:
                return SetParametersResult(
                    successful=False, reason='The period of diagnostics must be greater than 0'
                )
        return SetParametersResult(successful=True)

    def _change_period(self, parameters: Iterable[Any]) -> None:
        for each in parameters:
            if each.name == _PERIOD:
                self.period = float(each.value)
                self._timer.timer_period_ns = int(self.period * 1e9)
                self._timer.reset()

    def update(self) -> None:
        """Run the tasks and publish, if the last time was at least a period ago."""
        if self.node.get_clock().now() - self._last >= Duration(seconds=self.period):
            self.force_update()

    def force_update(self) -> None:
        """Run the tasks and publish now."""
        self._last = self.node.get_clock().now()
        with self.lock:
            tasks = list(self.tasks)
        found = []
        for task in tasks:
            status = self._status(task, DiagnosticStatus.ERROR, 'The task has set no message')
            found.append(task.run(status))
        self._warn(found)
        self.publish(found)

    def _warn(self, found: list[DiagnosticStatusWrapper]) -> None:
        if not self.hwid and found and not self._warned_of_hardware:
            self._warned_of_hardware = True
            self.node.get_logger().warning(
                'The diagnostics have no hardware ID: call setHardwareID of the Updater, for '
                "instance with the serial number, or with 'none' if there is no device"
            )
        if self.verbose:
            for status in found:
                if status.level != DiagnosticStatus.OK:
                    self.node.get_logger().warning(
                        f'Diagnostics of {status.name}: level {status.level[0]}, {status.message}'
                    )

    def broadcast(self, lvl: bytes | int, msg: str) -> None:
        """
        Publish a level and a message for all tasks, without running them.

        Parameters
        ----------
        lvl
            The level, such as `DiagnosticStatus.WARN`.
        msg
            The message, such as one that the device is switched off.

        """
        with self.lock:
            tasks = list(self.tasks)
        self.publish([self._status(task, lvl, msg) for task in tasks])

    def setHardwareID(self, hwid: str) -> None:  # noqa: N802
        """
        Set the ID of the device, which all diagnostics have.

        Parameters
        ----------
        hwid
            Such as its serial number; 'none' without a device.

        """
        self.hwid = hwid

    def addedTaskCallback(self, task: FunctionDiagnosticTask) -> None:  # noqa: N802
        """
        Publish that a task has been added.

        Parameters
        ----------
        task
            The task.

        """
        self.publish(self._status(task, DiagnosticStatus.OK, 'The node is starting up'))

    def _status(
        self, task: FunctionDiagnosticTask, level: bytes | int, message: str
    ) -> DiagnosticStatusWrapper:
        return DiagnosticStatusWrapper(
            level=level_of(level), name=task.name, message=message, hardware_id=self.hwid
        )

    def publish(self, msg: DiagnosticStatus | Iterable[DiagnosticStatus]) -> None:
        """
        Publish diagnostics, with the name of the node before their names.

        Parameters
        ----------
        msg
            One or several of them.

        """
        several = [msg] if isinstance(msg, DiagnosticStatus) else msg
        array = DiagnosticArray()
        array.header.stamp = self.node.get_clock().now().to_msg()
        array.status = [
            DiagnosticStatus(
                level=each.level,
                name=f'{self.node.get_name()}: {each.name}',
                message=each.message,
                hardware_id=each.hardware_id,
                values=each.values,
            )
            for each in several
        ]
        self.publisher.publish(array)
