# SPDX-License-Identifier: Apache-2.0
"""The event that sends a signal to certain processes."""

from __future__ import annotations

from collections.abc import Callable
import signal
from typing import TYPE_CHECKING, Union

from launch.events.process.process_targeted_event import ProcessTargetedEvent

if TYPE_CHECKING:
    from launch.actions.execute_local import ExecuteLocal


class SignalProcess(ProcessTargetedEvent):
    """
    Event that requests sending a signal to certain processes.

    Parameters
    ----------
    signal_number
        The signal, as its name (`'SIGINT'`) or its number.
    process_matcher
        Called with the action of a process; returns whether the event targets it.

    Raises
    ------
    KeyError
        There is no signal with this name.
    ValueError
        There is no signal with this number.

    """

    name = 'launch.events.process.SignalProcess'

    def __init__(
        self,
        *,
        signal_number: Union[str, signal.Signals, int],
        process_matcher: Callable[[ExecuteLocal], bool],
    ) -> None:
        super().__init__(process_matcher=process_matcher)
        self.__signal = (
            signal.Signals[signal_number]
            if isinstance(signal_number, str)
            else signal.Signals(signal_number)
        )

    @property
    def signal(self) -> signal.Signals:
        """Return the signal."""
        return self.__signal

    @property
    def signal_name(self) -> str:
        """Return the name of the signal, such as SIGINT."""
        return self.__signal.name
