# SPDX-License-Identifier: Apache-2.0
"""Read the graph and watch it change."""

from __future__ import annotations

from collections.abc import Callable
import sys
import time
from types import TracebackType
from typing import TypeVar

from ros2cli.graph import DEFAULT_SPIN_TIME_S
from ros2cli.graph.graph import Graph
from ros2cli.graph.link import Link, open_link
from ros2cli.graph.reach import read_reach
from ros2cli.rtps.announcement import LEASE_S
from ros2cli.waiting import Patience

T = TypeVar('T')

# How many spin times to wait for processes that exist but do not answer: since their number
# last decreased, and in total.
PATIENCE = 8
MAX_PATIENCE = 40


class GraphWatch:
    """
    Watcher of the graph without rclpy; use it in a `with` statement, or close it.

    Parameters
    ----------
    spin_time_s
        How long to wait for participants that cannot be counted, that is, on other machines, in s.
    check
        Called repeatedly during each wait; an exception from it ends the wait.

    Raises
    ------
    RuntimeError
        The environment variables of discovery are not valid.

    """

    def __init__(
        self,
        spin_time_s: float = DEFAULT_SPIN_TIME_S,
        check: Callable[[], object] = lambda: None,
    ) -> None:
        self._check = check
        self._reach = read_reach()
        self._spin_time_s = spin_time_s
        self._link: Link | None = None
        self._start_s = self._latest_s = self._news_s = 0.0
        self._fewest_missing = sys.maxsize
        self._has_told = False

    def __enter__(self) -> GraphWatch:
        """Return the watch; nothing is sent yet."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Close the watch."""
        self.close()

    def close(self) -> None:
        """Send farewells to the participants and close the socket."""
        if self._link:
            self._link.close()
        self._link = None

    @property
    def graph(self) -> Graph:
        """Return the graph as known now, complete or not."""
        neighbours = self._link.observer.neighbours if self._link else []
        return Graph(
            (node for each in neighbours for node in each.nodes),
            (end for each in neighbours for end in each.endpoints.values()),
            (each.prefix for each in neighbours if not each.is_here),
        )

    @property
    def domain_id(self) -> int:
        """Return the ROS domain ID."""
        return self._reach.domain_id

    def settled(self, is_done: Callable[[Graph], object] = lambda _: False) -> Graph:
        """
        Wait until the graph is complete, or a condition is met.

        A participant that does not answer in time is not waited for again, and there is a warning.

        Parameters
        ----------
        is_done
            Whether a possibly incomplete graph meets the condition.

        Returns
        -------
        Graph
            The graph at the end of the wait.

        """
        self._exchange(waits=False)
        patience = Patience(self._link.awaited if self._link else '')
        while not self._is_settled() and not is_done(self.graph):
            if self._is_in_vain():
                self._tell_incomplete()
                break
            patience.check()
            self._exchange(waits=True)
        return self.graph

    def settled_with(self, find: Callable[[Graph], object]) -> Graph:
        """
        Wait for something within the spin time, then until the graph is complete.

        This way a command finds a node that was started just before it.

        Parameters
        ----------
        find
            Searches a graph; a falsy result means not found.

        Returns
        -------
        Graph
            The complete graph, whether or not the search succeeded.

        """
        self.wait_for(find, None, 0.0)
        return self.settled()

    def updated(self) -> Graph:
        """Return the current graph without waiting."""
        self._exchange(waits=False)
        return self.graph

    def wait_for(
        self,
        find: Callable[[Graph], T],
        patience: Patience | None,
        timeout_s: float = float('inf'),
    ) -> T:
        """
        Wait until a search of the graph succeeds.

        Parameters
        ----------
        find
            Searches a graph; a falsy result means not found.
        patience
            Reports the wait to the user; None for no report.
        timeout_s
            How long to wait in s, but at least the spin time.

        Returns
        -------
        T
            The last result of `find`, which is falsy after a timeout.

        """
        end_s = time.monotonic() + timeout_s
        found = find(self.settled(find))
        end_s = max(end_s, self._start_s + self._spin_time_s)
        while not found and time.monotonic() < end_s:
            if patience:
                patience.check()
            self._exchange(waits=True)
            found = find(self.graph)
        return found

    def _tell_incomplete(self) -> None:
        if self._link and not self._has_told:
            self._has_told = True
            print(self._link.why_incomplete, file=sys.stderr)

    def _exchange(self, *, waits: bool) -> None:
        """Exchange datagrams; restart discovery if our lease may have expired in a pause."""
        self._check()
        now_s = time.monotonic()
        if self._link and now_s - self._latest_s > LEASE_S / 2:
            self.close()
        if self._link is None:
            self._link = open_link(self._reach)
            self._start_s = self._news_s = now_s
            self._fewest_missing = sys.maxsize
        self._latest_s = now_s
        self._link.exchange(waits=waits)

    def _is_settled(self) -> bool:
        """Whether all counted participants are known, and the time for the others has passed."""
        if self._link is None or not self._link.observer.is_complete:
            return False
        is_over = self._latest_s >= self._start_s + self._spin_time_s
        return is_over or (self._reach.is_local and self._link.can_count)

    def _is_in_vain(self) -> bool:
        """Whether further answers are unlikely, because none has arrived for a while."""
        if self._link is None:
            return True
        missing = self._link.observer.missing
        if missing < self._fewest_missing:
            self._fewest_missing, self._news_s = missing, self._latest_s
        if self._link.is_hopeless:
            return self._latest_s >= self._start_s + self._spin_time_s
        end_s = self._start_s + MAX_PATIENCE * self._spin_time_s
        return self._latest_s > min(end_s, self._news_s + PATIENCE * self._spin_time_s)
