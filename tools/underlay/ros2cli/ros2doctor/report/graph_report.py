# SPDX-License-Identifier: Apache-2.0
"""Base class of the reports of running nodes."""

from __future__ import annotations

from ros2doctor.api.extension import DoctorReport
from ros2doctor.api.report import Report
from ros2doctor.facts.client_library import why_rclpy_does_not_start
from ros2doctor.facts.graph import Graph, read_graph


class GraphReport(DoctorReport):
    """Base class of a graph report; contains the reason if rclpy does not start."""

    TITLE = ''

    def report(self) -> Report:
        """Return the section."""
        report = Report(self.TITLE)
        why_not = why_rclpy_does_not_start()
        if why_not:
            report.add_to_report('not available', why_not)
        else:
            self.fill(report, read_graph())
        return report

    def fill(self, report: Report, graph: Graph) -> None:
        """
        Add the items about the graph.

        Parameters
        ----------
        report
            The section, with its title and without items.
        graph
            The facts about the running nodes, which `read_graph` reads once for all reports.

        Raises
        ------
        NotImplementedError
            A subclass does not override it.

        """
        raise NotImplementedError(f'{type(self).__name__} does not implement fill()')
