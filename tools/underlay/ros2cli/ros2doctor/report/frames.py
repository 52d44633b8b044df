# SPDX-License-Identifier: Apache-2.0
"""The trees of frames."""

from __future__ import annotations

from ros2doctor.api.report import Report
from ros2doctor.facts.graph import Graph
from ros2doctor.report.graph_report import GraphReport


class FramesReport(GraphReport):
    """Report of the transforms."""

    TITLE = 'TRANSFORMS'

    def category(self) -> str:
        """Return the category."""
        return 'frames'

    def fill(self, report: Report, graph: Graph) -> None:
        """
        Add each transform as `parent -> child`, with its topic.

        Parameters
        ----------
        report, graph
            As for `GraphReport.fill`.

        """
        for tree, parent, child in sorted(graph.transforms):
            report.add_to_report(tree, f'{parent} -> {child}')
