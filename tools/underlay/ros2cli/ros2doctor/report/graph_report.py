# SPDX-License-Identifier: Apache-2.0
"""What the reports of the running nodes have in common."""

from __future__ import annotations

from ros2doctor.api.extension import DoctorReport
from ros2doctor.api.report import Report
from ros2doctor.facts.graph import Graph, read_graph


class GraphReport(DoctorReport):
    """A report of the graph; without rclpy it says why there is none."""

    TITLE = ''

    def report(self) -> Report:
        """Return the section."""
        report = Report(self.TITLE)
        try:
            self.fill(report, read_graph())
        except (ImportError, RuntimeError) as error:
            report.add_to_report('not available', error)
        return report

    def fill(self, report: Report, graph: Graph) -> None:
        """Add what there is to say about a graph."""
        raise NotImplementedError(f'{type(self).__name__} does not implement fill()')
