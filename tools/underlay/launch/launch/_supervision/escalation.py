# SPDX-License-Identifier: Apache-2.0
"""End a process, gently first."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
import logging
import signal


class Escalation:
    """
    Ends a process: sends SIGINT, some time later SIGTERM, and at last SIGKILL.

    Parameters
    ----------
    label
        The label of the process, for the log.
    logger
        The logger that says what is sent.
    send
        Sends a signal to the process.
    sigterm_timeout
        The seconds from SIGINT to SIGTERM, as a text.
    sigkill_timeout
        The seconds from then to SIGKILL, as a text.

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
        """Send nothing more, because the process has ended."""
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
