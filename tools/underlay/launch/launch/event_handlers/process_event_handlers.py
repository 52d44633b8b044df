# SPDX-License-Identifier: Apache-2.0
"""The event handlers of the start, the output and the exit of processes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Optional, TYPE_CHECKING, Union

from launch.event_handlers.on_action_event_base import OnActionEventBase, Reaction
from launch.events.process import ProcessExited, ProcessIO, ProcessStarted
from launch.some_entities_type import SomeEntitiesType

if TYPE_CHECKING:
    from launch.actions.execute_local import ExecuteLocal
    from launch.launch_context import LaunchContext


class OnProcessStart(OnActionEventBase):
    """
    Event handler that reacts when a process was started.

    Parameters
    ----------
    target_action
        The action of a process, a predicate that accepts such, or None for all.
    on_start
        The entities that are visited, or a function of the event and the context that returns
        them.
    **kwargs
        Keyword arguments of `BaseEventHandler`, such as `handle_once`.

    Raises
    ------
    TypeError
        The target or the reaction has the wrong type.

    """

    def __init__(
        self,
        *,
        target_action: Optional[Union[Callable[[Any], bool], ExecuteLocal]] = None,
        on_start: Reaction,
        **kwargs: Any,
    ) -> None:
        from launch.actions.execute_local import ExecuteLocal

        super().__init__(
            action_matcher=target_action,
            on_event=on_start,
            target_event_cls=ProcessStarted,
            target_action_cls=ExecuteLocal,
            **kwargs,
        )


IOReaction = Callable[[ProcessIO], Optional[SomeEntitiesType]]


class OnProcessIO(OnActionEventBase):
    """
    Event handler that reacts to the input and output of a process.

    Parameters
    ----------
    target_action
        The action of a process, a predicate that accepts such, or None for all.
    on_stdin, on_stdout, on_stderr
        Called with the event of bytes for or from this stream; may return entities that are
        visited next.
    **kwargs
        Keyword arguments of `BaseEventHandler`, such as `handle_once`.

    Raises
    ------
    TypeError
        A reaction is not callable, or the target has the wrong type.

    """

    def __init__(
        self,
        *,
        target_action: Optional[Union[Callable[[Any], bool], ExecuteLocal]] = None,
        on_stdin: Optional[IOReaction] = None,
        on_stdout: Optional[IOReaction] = None,
        on_stderr: Optional[IOReaction] = None,
        **kwargs: Any,
    ) -> None:
        from launch.actions.execute_local import ExecuteLocal

        self.__reactions: dict[int, Optional[IOReaction]] = {
            0: on_stdin,
            1: on_stdout,
            2: on_stderr,
        }
        for reaction in self.__reactions.values():
            if reaction is not None and not callable(reaction):
                raise TypeError(
                    'expected the reactions of OnProcessIO to be callables that take the event, '
                    f"but got '{reaction!r}'"
                )
        super().__init__(
            action_matcher=target_action,
            on_event=self._react,
            target_event_cls=ProcessIO,
            target_action_cls=ExecuteLocal,
            **kwargs,
        )

    def _react(self, event: ProcessIO, context: LaunchContext) -> Optional[SomeEntitiesType]:
        """Call the reaction to the stream that the event belongs to."""
        stream = 0 if event.from_stdin else 1 if event.from_stdout else 2
        reaction = self.__reactions[stream]
        return reaction(event) if reaction is not None else None


class OnProcessExit(OnActionEventBase):
    """
    Event handler that reacts when a process has ended.

    Parameters
    ----------
    target_action
        The action of a process, a predicate that accepts such, or None for all.
    on_exit
        The entities that are visited, or a function of the event and the context that returns
        them.
    **kwargs
        Keyword arguments of `BaseEventHandler`, such as `handle_once`.

    Raises
    ------
    TypeError
        The target or the reaction has the wrong type.

    """

    def __init__(
        self,
        *,
        target_action: Optional[Union[Callable[[Any], bool], ExecuteLocal]] = None,
        on_exit: Reaction,
        **kwargs: Any,
    ) -> None:
        from launch.actions.execute_local import ExecuteLocal

        super().__init__(
            action_matcher=target_action,
            on_event=on_exit,
            target_event_cls=ProcessExited,
            target_action_cls=ExecuteLocal,
            **kwargs,
        )
