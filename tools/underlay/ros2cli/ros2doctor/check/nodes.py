# SPDX-License-Identifier: Apache-2.0
"""Check that every node has a name of its own."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator

from ros2doctor.api.finding import Finding, Severity
from ros2doctor.check.graph_check import GraphCheck
from ros2doctor.facts.graph import Graph


class NodesCheck(GraphCheck):
    """The check of the names of the running nodes."""

    def category(self) -> str:
        """Return the name."""
        return 'nodes'

    def findings(self, graph: Graph) -> Iterator[Finding]:
        """Yield the names that several nodes have."""
        yield from name_findings(graph.nodes)


def name_findings(names: Iterable[str]) -> Iterator[Finding]:
    """Yield the names that are there several times."""
    for name, count in sorted(Counter(names).items()):
        last = name.rpartition('/')[2]
        if count > 1:
            yield Finding(
                Severity.WARNING,
                f"{count} nodes have the name '{name}'",
                'calls to its services and parameters reach any of them; often one is left over '
                'from an earlier start',
                f'end the one that is not meant (pgrep -af {last} may show the processes), or '
                f'start it under another name: ros2 run ... --ros-args -r __node:={last}_2',
            )
