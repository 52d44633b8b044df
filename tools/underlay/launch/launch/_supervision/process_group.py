# SPDX-License-Identifier: Apache-2.0
"""Signal and terminate process groups: a process and the processes that it has started."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
import logging
import os
import signal

_TO_THE_GROUP = frozenset(
    (signal.SIGINT, signal.SIGTERM, signal.SIGQUIT, signal.SIGKILL, signal.SIGSTOP, signal.SIGCONT)
)
_STEPS = ((signal.SIGINT, 0.5), (signal.SIGTERM, 1.0), (signal.SIGKILL, 1.0))
_LOOK_EVERY_S = 0.02


def send_signal(pid: int, number: signal.Signals) -> None:
    """
    Send a signal to a process that leads its group.

    Signals that terminate, stop or continue go to the whole group, because the process may be a
    wrapper around the actual program; other signals go to the process alone.

    Parameters
    ----------
    pid
        The id of the process, which is also that of the group; nothing is done if it has ended.
    number
        The signal.

    """
    try:
        if number in _TO_THE_GROUP:
            os.killpg(pid, number)
        else:
            os.kill(pid, number)
    except (ProcessLookupError, PermissionError):
        pass  # it has exited, or belongs to another user


def is_empty(group: int) -> bool:
    """
    Whether no process of a group is left, apart from zombies.

    Parameters
    ----------
    group
        The id of the group.

    """
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return True
    except PermissionError:
        return False
    return not living_members(group)


def living_members(group: int) -> list[int]:
    """
    List the ids of the processes of a group, except for zombies.

    Parameters
    ----------
    group
        The id of the group.

    """
    pids = [int(name) for name in os.listdir('/proc') if name.isdigit()]
    return [pid for pid in pids if _is_living_member(pid, group)]


def _is_living_member(pid: int, group: int) -> bool:
    try:
        with open(f'/proc/{pid}/stat', 'rb') as file:
            fields = file.read().rpartition(b')')[2].split()
    except OSError:
        return False
    return int(fields[2]) == group and fields[0] not in (b'Z', b'X')


class Escalation:
    """
    Termination of a process: SIGINT, then SIGTERM and SIGKILL after timeouts.

    Parameters
    ----------
    label
        The label of the process, for the log.
    logger
        The logger for the signals that are sent.
    send
        Sends a signal to the process.
    sigterm_timeout
        The time from SIGINT to SIGTERM in s, as a string.
    sigkill_timeout
        The time from SIGTERM to SIGKILL in s, as a string.

    Raises
    ------
    ValueError
        A timeout is not a number.

    """

    def __init__(
        self,
        *,
        label: str,
        logger: logging.Logger,
        send: Callable[[signal.Signals], None],
        sigterm_timeout: str,
        sigkill_timeout: str,
    ) -> None:
        self._label = label
        self._logger = logger
        self._send = send
        self._sigterm_timeout = sigterm_timeout
        self._sigterm_s = float(sigterm_timeout)
        self._sigkill_s = self._sigterm_s + float(sigkill_timeout)
        self._timers: list[asyncio.TimerHandle] = []

    def begin(self, loop: asyncio.AbstractEventLoop) -> None:
        """
        Send SIGINT now and schedule the other signals.

        Parameters
        ----------
        loop
            The event loop that runs the timers.

        """
        self.send_logged(signal.SIGINT)
        self._timers = [
            loop.call_later(
                self._sigterm_s, self._step, self._sigterm_timeout, signal.SIGINT, signal.SIGTERM
            ),
            loop.call_later(
                self._sigkill_s, self._step, self._sigkill_s, signal.SIGTERM, signal.SIGKILL
            ),
        ]

    def cancel(self) -> None:
        """Cancel the pending signals after the process has exited."""
        for timer in self._timers:
            timer.cancel()

    def send_logged(self, number: signal.Signals) -> None:
        """
        Send a signal and log it.

        Parameters
        ----------
        number
            The signal.

        """
        self._logger.info("sending signal '%s' to process[%s]", number.name, self._label)
        self._send(number)

    def _step(self, waited: object, last: signal.Signals, following: signal.Signals) -> None:
        self._logger.error(
            "process[%s] failed to terminate '%s' seconds after receiving '%s', escalating to "
            "'%s'",
            self._label,
            waited,
            last.name,
            following.name,
        )
        self.send_logged(following)


async def end_leftovers(group: int, *, was_interrupted: bool) -> None:
    """
    Terminate a process group whose leader has exited, with SIGINT, SIGTERM and SIGKILL.

    Parameters
    ----------
    group
        The id of the group.
    was_interrupted
        Whether the group has already received SIGINT; it is not sent again.

    """
    for number, patience_s in _STEPS:
        if is_empty(group):
            return
        if number != signal.SIGINT or not was_interrupted:
            send_signal(group, number)
        await _wait_until_empty(group, patience_s)


async def _wait_until_empty(group: int, patience_s: float) -> None:
    loop = asyncio.get_running_loop()
    end = loop.time() + patience_s
    while loop.time() < end and not is_empty(group):
        await asyncio.sleep(_LOOK_EVERY_S)
