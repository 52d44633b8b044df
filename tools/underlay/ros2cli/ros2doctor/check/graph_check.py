# SPDX-License-Identifier: Apache-2.0
"""Base class of the checks of running nodes."""

from __future__ import annotations

from collections.abc import Iterator

from ros2doctor.api.extension import DoctorCheck
from ros2doctor.api.finding import Finding, Result
from ros2doctor.facts.client_library import why_rclpy_does_not_start
from ros2doctor.facts.graph import Graph, read_graph


class GraphCheck(DoctorCheck):
    """Base class of a graph check; skipped if rclpy does not start, which has its own check."""

    def check(self) -> Result:
        """Check the graph."""
        if why_rclpy_does_not_start():
            return Result()
        return Result(self.findings(read_graph()))

    def findings(self, graph: Graph) -> Iterator[Finding]:
        """
        Check the graph of the running nodes.

        Parameters
        ----------
        graph
            The facts about the running nodes, which `read_graph` reads once for all checks.

        Yields
        ------
        Finding
            A problem.

        Raises
        ------
        NotImplementedError
            A subclass does not override it.

        """
        raise NotImplementedError(f'{type(self).__name__} does not implement findings()')
