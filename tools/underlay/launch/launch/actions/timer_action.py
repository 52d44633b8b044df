# SPDX-License-Identifier: Apache-2.0
"""The action that visits other actions after a delay, in the scope in which it was started."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Optional, Protocol, TYPE_CHECKING, Union

from launch.action import Action
from launch.event_handler import EventHandler
from launch.event_handlers.on_shutdown import OnShutdown
from launch.events import TimerEvent
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.substitution import SomeSubstitutionsType
from launch.utilities.arguments import list_like, typed
from launch.utilities.type_utils import normalize_typed_substitution, perform_typed_substitution

if TYPE_CHECKING:
    import asyncio

    from launch.frontend.entity import Entity
    from launch.frontend.parser import Parser
    from launch.launch_context import LaunchContext


class Cancelable(Protocol):
    """Running timer that can be canceled."""

    def cancel(self) -> None:
        """Cancel the timer."""


class TimerAction(Action):
    """
    Action that visits others once, when a period is over, in the scope in which it was started.

    Parameters
    ----------
    period
        The period in s: a float, or substitutions that resolve to one.
    actions
        The actions to visit after the period.
    cancel_on_shutdown
        Whether a shutdown cancels the timer; otherwise the launch waits for it.
    **kwargs
        Keyword arguments of `Action`.

    Raises
    ------
    TypeError
        The period is an int, or another argument has the wrong type.

    """

    def __init__(
        self,
        *,
        period: Union[float, SomeSubstitutionsType],
        actions: Iterable[LaunchDescriptionEntity],
        cancel_on_shutdown: Union[bool, SomeSubstitutionsType] = True,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.__period = _checked_period(period)
        self.__actions = list_like('actions', actions, 'actions')
        self.__cancel_on_shutdown = normalize_typed_substitution(cancel_on_shutdown, bool)
        self.__done: Optional[asyncio.Future[None]] = None
        self.__timer: Optional[Cancelable] = None
        self.__canceled = False

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """
        Read `period`, `cancel_on_shutdown` and the actions of the element `timer`.

        Parameters
        ----------
        entity, parser
            As for `Action.parse`.

        Returns
        -------
        tuple
            The class, and the keyword arguments for its constructor.

        """
        _, kwargs = super().parse(entity, parser)
        period = entity.get_attr('period', data_type=float)
        kwargs['period'] = parser.parse_if_substitutions(period)
        cancel = entity.get_attr('cancel_on_shutdown', data_type=bool, optional=True)
        if cancel is not None:
            kwargs['cancel_on_shutdown'] = parser.parse_if_substitutions(cancel)
        kwargs['actions'] = parser.parse_actions(entity.children)
        return cls, kwargs

    @property
    def period(self) -> Any:
        """Return the period in s, or the substitutions that resolve to it."""
        return self.__period

    @property
    def actions(self) -> list[LaunchDescriptionEntity]:
        """Return the actions."""
        return self.__actions

    def describe(self) -> str:
        """Return a short human-readable description."""
        return f'TimerAction(period={self.__period}, actions=<actions>)'

    def describe_conditional_sub_entities(
        self,
    ) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """Return the actions, which wait for the timer."""
        return [(f'after {self.__period} second(s)', self.__actions)]

    def outline_of_waiting(self) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """Return the actions, which wait for the period to pass."""
        period = self.__period
        if isinstance(period, list):
            period = ' + '.join(part.describe() for part in period)
        return [(f'{period} s to pass', self.__actions)]

    def execute(self, context: LaunchContext) -> None:
        """
        Start the timer, unless it was canceled or the launch is shutting down.

        Parameters
        ----------
        context
            The context of a running launch; its configurations are captured for the actions.

        Raises
        ------
        RuntimeError
            The launch is not running.

        """
        if self.__canceled or context.is_shutdown:
            return
        if context.asyncio_loop is None:
            raise RuntimeError('a TimerAction can only be executed by a running launch')
        self.__done = context.asyncio_loop.create_future()
        context.register_event_handler(self._reaction(context))
        if perform_typed_substitution(context, self.__cancel_on_shutdown, bool):
            context.register_event_handler(OnShutdown(on_shutdown=lambda *_: self.cancel()))
        period_s = perform_typed_substitution(context, self.__period, float)
        if context.run.observer is not None:
            context.run.observer.note_waiting(f'{period_s} s to pass', self.__actions)
            return
        self.__timer = self._start(context, context.asyncio_loop, period_s)

    def _start(
        self,
        context: LaunchContext,
        loop: asyncio.AbstractEventLoop,
        period_s: float,
    ) -> Cancelable:
        """Start the period; subclasses measure it by other clocks."""
        return loop.call_later(period_s, self._run_out, context)

    def _reaction(self, context: LaunchContext) -> EventHandler:
        """Create the handler that visits the actions in the current scope."""
        configurations = context.launch_configurations.snapshot()
        entities = [
            EnterScope(configurations, context.get_locals_as_dict()),
            *self.__actions,
            LeaveScope(),
        ]
        return EventHandler(
            matcher=lambda event: isinstance(event, TimerEvent) and event.timer_action is self,
            entities=entities,
            handle_once=True,
        )

    def _run_out(self, context: LaunchContext) -> None:
        if not self.__canceled:
            context.emit_event_sync(TimerEvent(timer_action=self))
            self._finish()

    def cancel(self) -> None:
        """Cancel the timer, or prevent it from starting."""
        self.__canceled = True
        if self.__timer is not None:
            self.__timer.cancel()
        self._finish()

    def _finish(self) -> None:
        if self.__done is not None and not self.__done.done():
            self.__done.set_result(None)

    def get_asyncio_future(self) -> Optional[asyncio.Future[None]]:
        """Return a future that is done when the timer has expired or is canceled."""
        return self.__done


def _checked_period(period: Any) -> Any:
    """Normalise the period to a float or substitutions; reject ints, and warn about strings."""
    if isinstance(period, int) and not isinstance(period, bool):
        raise TypeError(
            'the period of a TimerAction must be a float or a substitution, but it is the '
            f'{type(period).__name__} {period}: write {float(period)} instead'
        )
    if isinstance(period, str):
        _warn_of_text(period)
    return typed('period', period, float, 'a float or a substitution')


def _warn_of_text(period: str) -> None:
    import warnings

    warnings.warn(
        'the period of a TimerAction should be a float or substitutions, not the string '
        f"'{period}'",
        stacklevel=4,
    )


class EnterScope(LaunchDescriptionEntity):
    """
    Entity that opens a scope with captured launch configurations.

    Parameters
    ----------
    configurations
        The captured launch configurations, which replace the current ones.
    local_variables
        The captured local variables, which are added to the current ones; `event` is kept.

    """

    def __init__(self, configurations: dict[str, Any], local_variables: dict[str, Any]) -> None:
        self._configurations = configurations
        self._locals = local_variables

    def visit(self, context: LaunchContext) -> None:
        """
        Replace the launch configurations until `LeaveScope` is visited.

        Parameters
        ----------
        context
            The launch context.

        """
        context.launch_configurations.push_scope()
        context.launch_configurations.clear()
        context.launch_configurations.update(self._configurations)
        event = context.get_locals_as_dict().get('event')
        context.extend_locals({**self._locals, 'event': event})


class LeaveScope(LaunchDescriptionEntity):
    """Entity that closes the scope."""

    def visit(self, context: LaunchContext) -> None:
        """
        Restore the launch configurations from before the scope.

        Parameters
        ----------
        context
            The launch context.

        """
        context.launch_configurations.pop_scope()
