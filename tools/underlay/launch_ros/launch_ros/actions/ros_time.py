# SPDX-License-Identifier: Apache-2.0
"""The ROS time of a launch: which clock its own node follows, and a timer on it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TYPE_CHECKING, Union

from launch.action import Action
from launch.actions.timer_action import TimerAction
from launch.event_handlers.on_shutdown import OnShutdown
from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType
from launch.utilities.type_utils import normalize_typed_substitution, perform_typed_substitution

if TYPE_CHECKING:
    import asyncio

    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
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


RosTimer = ROSTimer


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


class SetUseSimTime(Action):
    """
    Chooses whether the launch's own ROS node follows simulation time.

    Launched nodes are not affected; use SetParameter('use_sim_time', True) for them.

    Parameters
    ----------
    value
        Whether the clock of that node follows `/clock`.
    **kwargs
        As for `Action`: `condition`.

    Raises
    ------
    TypeError
        The value is neither a bool nor a string or substitution.

    """

    def __init__(self, value: Union[bool, SomeSubstitutionsType], **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__value = normalize_typed_substitution(value, bool)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """
        Parse an element of a launch file into the class and its keyword arguments.

        Parameters
        ----------
        entity
            The `set_use_sim_time` element, with the attribute `value`.
        parser
            Parses substitutions in its attributes.

        Returns
        -------
        tuple
            The class and the keyword arguments of its constructor.

        """
        _, kwargs = super().parse(entity, parser)
        value = entity.get_attr('value', data_type=bool)
        kwargs['value'] = parser.parse_if_substitutions(value)
        return cls, kwargs

    @property
    def value(self) -> Any:
        """Return the value, or the substitutions that evaluate to it."""
        return self.__value

    def execute(self, context: LaunchContext) -> None:
        """
        Select the clock, also for a node that is created later.

        Parameters
        ----------
        context
            The launch context; its global `launch_use_sim_time` stores the value.

        Raises
        ------
        ValueError
            The substituted value is not a boolean.

        """
        from launch_ros.ros_adapters import find_ros_adapter

        value = perform_typed_substitution(context, self.__value, bool)
        context.extend_globals({'launch_use_sim_time': value})
        adapter = find_ros_adapter(context)
        if adapter is not None:
            adapter.set_use_sim_time(value)
