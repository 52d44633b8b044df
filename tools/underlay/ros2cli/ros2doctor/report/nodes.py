# SPDX-License-Identifier: Apache-2.0
"""The running nodes and their topics."""

from __future__ import annotations

from collections import Counter

from ros2doctor.api.report import Report
from ros2doctor.facts.graph import Graph
from ros2doctor.report.graph_report import GraphReport


class NodesReport(GraphReport):
    """Report of the running nodes and their topics."""

    TITLE = 'NODES AND TOPICS'

    def category(self) -> str:
        """Return the category."""
        return 'nodes'

    def fill(self, report: Report, graph: Graph) -> None:
        """
        Add the nodes, and the number of publishers and subscriptions of each topic.

        Parameters
        ----------
        report, graph
            As for `GraphReport.fill`.

        """
        for name in graph.nodes:
            report.add_to_report('node', name)
        counts = Counter((each.topic, each.is_publisher) for each in graph.endpoints)
        for topic, name in sorted({(each.topic, each.type_name) for each in graph.endpoints}):
            numbers = f'{counts[topic, True]} publishers, {counts[topic, False]} subscriptions'
            report.add_to_report('topic', f'{topic} [{name}]: {numbers}')
