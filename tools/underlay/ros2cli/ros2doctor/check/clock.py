# SPDX-License-Identifier: Apache-2.0
"""Check that /clock is published if nodes use simulated time."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from ros2doctor.api.extension import Finding, Severity
from ros2doctor.check.graph import Graph, GraphCheck


class ClockCheck(GraphCheck):
    """Check of the time that a simulator or a bag publishes."""

    def category(self) -> str:
        """Return the category."""
        return 'clock'

    def findings(self, graph: Graph) -> Iterator[Finding]:
        """
        Check for nodes whose time stands still because /clock is not published.

        Parameters
        ----------
        graph
            As for `GraphCheck.findings`; its `without_clock` is examined.

        Yields
        ------
        Finding
            At most one error.

        """
        yield from clock_findings(graph.without_clock)


def clock_findings(nodes: Collection[str]) -> Iterator[Finding]:
    """
    Report one error about all nodes that wait for a /clock without publishers.

    Parameters
    ----------
    nodes
        Full names of the nodes.

    Yields
    ------
    Finding
        The error; nothing without nodes.

    """
    if nodes:
        yield Finding(
            Severity.ERROR,
            f'use_sim_time is true, but there is no publisher on /clock: {", ".join(nodes)}',
            'the time of these nodes stands still: their timers do not fire, and the '
            'transforms that they publish do not change',
            'start the simulator, or play the bag with --clock; without one, start these nodes '
            'without use_sim_time, or set it back: ros2 param set NODE use_sim_time false',
        )
