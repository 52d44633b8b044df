# SPDX-License-Identifier: Apache-2.0
"""Control of a running recorder or player by keys, services and signals."""

from __future__ import annotations

from collections.abc import Callable
import os
import select
import signal
import sys
import termios
from types import FrameType, TracebackType
from typing import Any

from rclpy.executors import ExternalShutdownException
from rclpy.signals import uninstall_signal_handlers

__all__ = [
    'DOWN',
    'RIGHT',
    'SPACE',
    'UP',
    'Keyboard',
    'PauseSwitch',
    'StopSignals',
    'offer_pause_services',
    'offer_service',
]

SPACE, UP, DOWN, RIGHT = ' ', '\x1b[A', '\x1b[B', '\x1b[C'
MAX_BYTES = 64
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


class PauseSwitch:
    """
    The paused state of a recorder or player.

    Parameters
    ----------
    is_paused
        Whether it starts paused; also an attribute with the current state.
    say
        Called with a message at each change.

    """

    def __init__(self, is_paused: bool, say: Callable[[str], object]) -> None:
        self.is_paused = is_paused
        self._say = say

    def change_to(self, is_paused: bool) -> None:
        """
        Pause or resume; nothing is reported without a change.

        Parameters
        ----------
        is_paused
            Whether to pause.

        """
        if is_paused != self.is_paused:
            self.is_paused = is_paused
            self._say('Paused.' if is_paused else 'Resumed.')

    def toggle(self) -> None:
        """Toggle the paused state."""
        self.change_to(not self.is_paused)


def offer_pause_services(node: Any, switch: PauseSwitch) -> None:
    """
    Create the services `~/pause`, `~/resume`, `~/toggle_paused` and `~/is_paused`.

    Parameters
    ----------
    node
        The node that offers them.
    switch
        The paused state that they change.

    """
    from rosbag2_interfaces.srv import IsPaused, Pause, Resume, TogglePaused

    def tell(_: Any, response: Any) -> None:
        response.paused = switch.is_paused

    offer_service(node, Pause, 'pause', lambda *_: switch.change_to(True))
    offer_service(node, Resume, 'resume', lambda *_: switch.change_to(False))
    offer_service(node, TogglePaused, 'toggle_paused', lambda *_: switch.toggle())
    offer_service(node, IsPaused, 'is_paused', tell)


def offer_service(node: Any, kind: Any, name: str, act: Callable[[Any, Any], None]) -> None:
    """
    Create a service in the namespace of a node.

    Parameters
    ----------
    node
        The node that offers it.
    kind
        The type of the service.
    name
        Its name after that of the node.
    act
        Called with the request and the response to fill in.

    """

    def serve(request: Any, response: Any) -> Any:
        act(request, response)
        return response

    node.create_service(kind, f'~/{name}', serve)


class Keyboard:
    """
    Non-blocking reader of pressed keys; use it in a `with` statement.

    It reports none if stdin is not a terminal, or if the command runs in the background.

    Parameters
    ----------
    enabled
        Whether to read keys at all; if not, the terminal is left alone.

    """

    def __init__(self, *, enabled: bool) -> None:
        self._is_wanted = enabled
        self._before: list[Any] | None = None

    def __enter__(self) -> Keyboard:
        """Disable the line buffering and echo of the terminal; Ctrl-C still sends SIGINT."""
        if self._is_wanted and _is_in_foreground():
            self._before = termios.tcgetattr(sys.stdin)
            raw = termios.tcgetattr(sys.stdin)
            raw[3] &= ~(termios.ICANON | termios.ECHO)
            termios.tcsetattr(sys.stdin, termios.TCSADRAIN, raw)
        return self

    @property
    def is_reading(self) -> bool:
        """Whether keys are read."""
        return self._before is not None

    def pressed(self) -> str:
        """Return the keys pressed since the last call; '' for none."""
        if self._before is None or not select.select([sys.stdin], [], [], 0)[0]:
            return ''
        return os.read(sys.stdin.fileno(), MAX_BYTES).decode(errors='ignore')

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Restore the terminal settings."""
        if self._before is not None:
            termios.tcsetattr(sys.stdin, termios.TCSADRAIN, self._before)


def _is_in_foreground() -> bool:
    """Whether stdin is a terminal and this process is in its foreground process group."""
    if sys.stdin is None or not sys.stdin.isatty():
        return False
    try:
        return os.tcgetpgrp(sys.stdin.fileno()) == os.getpgrp()
    except OSError:
        return False


class StopSignals:
    """Recorder of SIGINT, SIGTERM and SIGHUP; use it in a `with` statement."""

    def __init__(self) -> None:
        """Initialize without installing handlers."""
        self._first: int | None = None
        self._before: dict[signal.Signals, Any] = {}

    def __enter__(self) -> StopSignals:
        """Replace the signal handlers of rclpy."""
        uninstall_signal_handlers()
        for number in SIGNALS:
            self._before[number] = signal.signal(number, self._note)
        return self

    def __bool__(self) -> bool:
        """Whether a signal has been received."""
        return self._first is not None

    def raise_if_any(self) -> None:
        """Raise the exception of the first signal, for the exit status."""
        if self._first == signal.SIGINT:
            raise KeyboardInterrupt
        if self._first is not None:
            raise ExternalShutdownException

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Restore the previous signal handlers."""
        for number, handler in self._before.items():
            signal.signal(number, handler)

    def _note(self, number: int, frame: FrameType | None) -> None:
        if self._first is None:
            self._first = number
