# SPDX-License-Identifier: Apache-2.0
"""Wait in one thread for what another one notes."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
import threading
import time

from launch_testing.util.resolve_processes import NoMatchingProcessException


class Waiting:
    """Something that changes in one thread while others wait for a state of it."""

    def __init__(self) -> None:
        """Create it."""
        self._condition = threading.Condition()
        self._closed = False

    @contextmanager
    def changing(self) -> Iterator[None]:
        """Wake those who wait at the end of a block that changes something."""
        with self._condition:
            yield
            self._condition.notify_all()

    def close(self) -> None:
        """Let nobody wait any longer: the launch is over and nothing changes any more."""
        with self.changing():
            self._closed = True

    def why_in_vain(self, timeout: float) -> str:
        """
        Return the beginning of the message about a wait that has failed.

        Parameters
        ----------
        timeout
            How long was waited, in s.

        """
        if self._closed:
            return 'The launch ended while a test waited'
        return f'Waited {timeout:g} s in vain'

    def wait_until(self, predicate: Callable[[], bool], timeout: float) -> bool:
        """
        Wait until a predicate holds, or until the end of the launch.

        Parameters
        ----------
        predicate
            Called without arguments whenever something has changed.
        timeout
            The timeout in s.

        Returns
        -------
        bool
            Whether the predicate holds.

        Raises
        ------
        NoMatchingProcessException
            The predicate still raises this at the end, as no process is the one meant.

        """
        end = time.monotonic() + timeout
        with self._condition:
            while not self._holds(predicate):
                left = end - time.monotonic()
                if self._closed or left <= 0:
                    self._require_processes(predicate)
                    return False
                self._condition.wait(left)
        return True

    @staticmethod
    def _holds(predicate: Callable[[], bool]) -> bool:
        """Return whether a predicate holds, as far as its process is there yet."""
        try:
            return predicate()
        except NoMatchingProcessException:
            return False

    @staticmethod
    def _require_processes(predicate: Callable[[], bool]) -> None:
        """Raise the error about a process that has never been there."""
        predicate()
