# SPDX-License-Identifier: Apache-2.0
"""Read the graph, and see it change."""

from __future__ import annotations

from collections.abc import Callable
import sys
import time
from types import TracebackType
from typing import TypeVar

from ros2cli.graph import DEFAULT_SPIN_TIME_S
from ros2cli.graph.graph import Graph
from ros2cli.graph.link import Link
from ros2cli.graph.reach import read_reach
from ros2cli.patience import Patience
from ros2cli.rtps.greeting import LEASE_S

T = TypeVar('T')

# How many times as long as the spin time processes are waited for that are there, but do not
# answer: since there were the fewest of them, and in all.
PATIENCE = 8
MAX_PATIENCE = 40
INCOMPLETE = (
    'WARNING: a ROS process on this machine does not answer (is it stopped, or just starting?); '
    'what follows may be incomplete'
)


class GraphWatch:
    """
    Reads the graph and sees it change, without rclpy; use it in a `with` statement, or close it.

    Parameters
    ----------
    spin_time_s
        How long to wait for those who cannot be counted, that is, nodes on other machines, in s.
    check
        Called again and again during each wait; what it raises ends the wait.

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
        """Nobody is asked yet."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Close it."""
        self.close()

    def close(self) -> None:
        """Take leave of those who were asked."""
        if self._link:
            self._link.close()
        self._link = None

    @property
    def graph(self) -> Graph:
        """Return what is known now, complete or not."""
        neighbours = self._link.observer.neighbours if self._link else []
        return Graph(
            (node for each in neighbours for node in each.nodes),
            (end for each in neighbours for end in each.endpoints.values()),
            (each.prefix for each in neighbours if not each.is_here),
        )

    @property
    def domain_id(self) -> int:
        """Return the domain that is looked at."""
        return self._reach.domain_id

    def settled(self, is_done: Callable[[Graph], object] = lambda _: False) -> Graph:
        """
        Wait until the graph is complete, or has what is looked for.

        A participant that does not answer in time is not waited for again, and there is a warning.

        Parameters
        ----------
        is_done
            Whether a graph that may be incomplete has what is looked for.

        Returns
        -------
        Graph
            The graph at the end of the wait.

        """
        patience = Patience('the answers of all ROS processes on this machine')
        self._exchange(waits=False)
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

        So a command finds a node that has been started just before it.

        Parameters
        ----------
        find
            What is looked for in a graph; what is false is not found.

        Returns
        -------
        Graph
            The complete graph, with or without what is looked for.

        """
        self.wait_for(find, None, 0.0)
        return self.settled()

    def updated(self) -> Graph:
        """Return what is known at this moment, without waiting for anybody."""
        self._exchange(waits=False)
        return self.graph

    def wait_for(
        self,
        find: Callable[[Graph], T],
        patience: Patience | None,
        timeout_s: float = float('inf'),
    ) -> T:
        """
        Wait until something is found in the graph.

        Parameters
        ----------
        find
            What is looked for in a graph; what is false is not found.
        patience
            What tells the user about the wait; None says nothing.
        timeout_s
            How long to wait in s, but at least the spin time.

        Returns
        -------
        T
            What `find` has returned last, which is false if the time is over.

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
        if not self._has_told:
            self._has_told = True
            print(INCOMPLETE, file=sys.stderr)

    def _exchange(self, *, waits: bool) -> None:
        """Hear what is new; after a pause, in which others have given us up, ask all anew."""
        self._check()
        now_s = time.monotonic()
        if self._link and now_s - self._latest_s > LEASE_S / 2:
            self.close()
        if self._link is None:
            self._link = Link(self._reach)
            self._start_s = self._news_s = now_s
            self._fewest_missing = sys.maxsize
        self._latest_s = now_s
        self._link.exchange(waits=waits)

    def _is_settled(self) -> bool:
        """Tell if all is known of those who can be counted, and others have had their time."""
        if self._link is None or not self._link.observer.is_complete:
            return False
        is_over = self._latest_s >= self._start_s + self._spin_time_s
        return is_over or (self._reach.is_local and self._link.can_count)

    def _is_in_vain(self) -> bool:
        """Tell if who has not answered yet will hardly do so: for a while, nobody has."""
        if self._link is None:
            return True
        missing = self._link.observer.missing
        if missing < self._fewest_missing:
            self._fewest_missing, self._news_s = missing, self._latest_s
        if self._link.is_hopeless:
            return self._latest_s >= self._start_s + self._spin_time_s
        end_s = self._start_s + MAX_PATIENCE * self._spin_time_s
        return self._latest_s > min(end_s, self._news_s + PATIENCE * self._spin_time_s)
