# SPDX-License-Identifier: Apache-2.0
"""Wait in one thread for state changes made in another one."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
import threading
import time

from launch_testing.util.resolve_processes import NoMatchingProcessException


class Waiting:
    """Base class of objects that change in one thread while other threads wait for a state."""

    def __init__(self) -> None:
        """Create an open object that can be waited for."""
        self._condition = threading.Condition()
        self._closed = False

    @contextmanager
    def changing(self) -> Iterator[None]:
        """Wake the waiting threads at the end of a block that changes the state."""
        with self._condition:
            yield
            self._condition.notify_all()

    def close(self) -> None:
        """Abort all waits, as the launch has ended and the state will not change."""
        with self.changing():
            self._closed = True

    def why_in_vain(self, timeout: float) -> str:
        """
        Return the start of the error message for a failed wait.

        Parameters
        ----------
        timeout
            The timeout that has expired, in s.

        """
        if self._closed:
            return 'The launch ended while a test waited'
        return f'Timed out after waiting {timeout:g} s'

    def wait_until(self, predicate: Callable[[], bool], timeout: float) -> bool:
        """
        Wait until a predicate holds or the launch ends.

        Parameters
        ----------
        predicate
            Called without arguments after each change.
        timeout
            The timeout in s.

        Returns
        -------
        bool
            Whether the predicate holds.

        Raises
        ------
        NoMatchingProcessException
            The predicate still raises this at the end, as no process matches.

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
        """Whether a predicate holds; False while its process does not exist."""
        try:
            return predicate()
        except NoMatchingProcessException:
            return False

    @staticmethod
    def _require_processes(predicate: Callable[[], bool]) -> None:
        """Raise the error of the predicate if its process has never existed."""
        predicate()
