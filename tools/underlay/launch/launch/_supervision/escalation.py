# SPDX-License-Identifier: Apache-2.0
"""Termination of a process with escalating signals."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
import logging
import signal


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
