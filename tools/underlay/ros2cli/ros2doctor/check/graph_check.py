# SPDX-License-Identifier: Apache-2.0
"""What the checks of the running nodes have in common."""

from __future__ import annotations

from collections.abc import Iterator

from ros2doctor.api.extension import DoctorCheck
from ros2doctor.api.finding import Finding, Result, Severity
from ros2doctor.facts.graph import Graph, read_graph


class GraphCheck(DoctorCheck):
    """A check of the graph; without rclpy there is none to look at."""

    def check(self) -> Result:
        """Return what is wrong with the graph."""
        try:
            graph = read_graph()
        except (ImportError, RuntimeError) as error:
            return Result([_unreadable(error)])
        return Result(self.findings(graph))

    def findings(self, graph: Graph) -> Iterator[Finding]:
        """Yield what is wrong with a graph."""
        raise NotImplementedError(f'{type(self).__name__} does not implement findings()')


def _unreadable(error: Exception) -> Finding:
    return Finding(
        Severity.ERROR,
        f'the running nodes cannot be looked at: {error}',
        'nodes of your own cannot start either',
        'mend the errors above first',
    )
