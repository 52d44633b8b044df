# SPDX-License-Identifier: Apache-2.0
"""Pairs of publishers and subscriptions."""

from __future__ import annotations

from ros2doctor.api.report import Report
from ros2doctor.check.qos import pairs, why_nothing_passes
from ros2doctor.facts.graph import Graph
from ros2doctor.report.graph_report import GraphReport


class QosReport(GraphReport):
    """Report of the compatibility of publishers and subscriptions."""

    TITLE = 'QOS COMPATIBILITY LIST'

    def category(self) -> str:
        """Return the category."""
        return 'qos'

    def fill(self, report: Report, graph: Graph) -> None:
        """
        Add each pair of a publisher and a subscription, and whether they are compatible.

        Parameters
        ----------
        report, graph
            As for `GraphReport.fill`.

        """
        for publisher, subscription in pairs(graph.endpoints):
            reason = why_nothing_passes(publisher, subscription)
            report.add_to_report(
                publisher.topic,
                f'{publisher.node} -> {subscription.node}: {reason or "compatible"}',
            )
