# SPDX-License-Identifier: Apache-2.0
"""What the checks of the running nodes have in common."""

from __future__ import annotations

from collections.abc import Iterator

from ros2doctor.api.extension import DoctorCheck
from ros2doctor.api.finding import Finding, Result
from ros2doctor.facts.client_library import why_rclpy_does_not_start
from ros2doctor.facts.graph import Graph, read_graph


class GraphCheck(DoctorCheck):
    """A check of the graph; where rclpy does not start, which has a check, there is none."""

    def check(self) -> Result:
        """Return what is wrong with the graph."""
        if why_rclpy_does_not_start():
            return Result()
        return Result(self.findings(read_graph()))

    def findings(self, graph: Graph) -> Iterator[Finding]:
        """
        Check the graph of the running nodes.

        Parameters
        ----------
        graph
            All that is known of the running nodes, which `read_graph` reads once for all checks.

        Yields
        ------
        Finding
            What is wrong.

        Raises
        ------
        NotImplementedError
            A subclass does not override it.

        """
        raise NotImplementedError(f'{type(self).__name__} does not implement findings()')
