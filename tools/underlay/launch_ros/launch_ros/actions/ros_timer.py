# SPDX-License-Identifier: Apache-2.0
"""Launch timer on ROS time."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TYPE_CHECKING

from launch.actions.timer_action import TimerAction
from launch.event_handlers.on_shutdown import OnShutdown

if TYPE_CHECKING:
    import asyncio

    from launch.launch_context import LaunchContext


class ROSTimer(TimerAction):
    """
    Visits actions once, when a period of ROS time is over.

    That is simulation time after SetUseSimTime(True). The timer ends with the launch at the
    latest, regardless of `cancel_on_shutdown`, as the node with the clock is destroyed then.
    """

    def execute(self, context: LaunchContext) -> None:
        """
        Start the timer.

        Parameters
        ----------
        context
            The context of the running launch, whose own ROS node provides the clock.

        Raises
        ------
        RuntimeError
            The launch is not running.

        """
        super().execute(context)
        context.register_event_handler(
            OnShutdown(on_shutdown=lambda *_: self.cancel(), handle_once=True)
        )

    def _start(
        self,
        context: LaunchContext,
        loop: asyncio.AbstractEventLoop,
        period_s: float,
    ) -> Alarm:
        """Start the timer on the clock of the launch's own node."""
        from launch_ros.ros_adapters import get_ros_node

        def run_out() -> None:
            loop.call_soon_threadsafe(self._run_out, context)

        return Alarm(get_ros_node(context), period_s, run_out)


class Alarm:
    """
    One-shot timer of a node, which starts immediately.

    Parameters
    ----------
    node
        The rclpy node whose clock measures the period.
    period_s
        The period in s.
    callback
        Called once, without arguments, from the thread that spins the node.

    """

    def __init__(self, node: Any, period_s: float, callback: Callable[[], Any]) -> None:
        self._node = node
        self._callback = callback
        self._timer = node.create_timer(period_s, self._go_off, autostart=False)
        self._timer.reset()

    def _go_off(self) -> None:
        self.cancel()
        self._callback()

    def cancel(self) -> None:
        """Stop the timer."""
        self._node.destroy_timer(self._timer)
