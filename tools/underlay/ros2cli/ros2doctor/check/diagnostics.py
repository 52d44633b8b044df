# SPDX-License-Identifier: Apache-2.0
"""Check the diagnostics of running nodes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ros2doctor.api.extension import Finding, Severity
from ros2doctor.check.graph import Graph, GraphCheck
from ros2doctor.check.listening import Complaint, WARN


class DiagnosticsCheck(GraphCheck):
    """Check of the `diagnostics` topics."""

    def category(self) -> str:
        """Return the category."""
        return 'diagnostics'

    def findings(self, graph: Graph) -> Iterator[Finding]:
        """
        Check the diagnostic status of components.

        Parameters
        ----------
        graph
            As for `GraphCheck.findings`; its `complaints` are examined.

        Yields
        ------
        Finding
            One for each component that is not OK.

        """
        yield from diagnostics_findings(graph.complaints)


def diagnostics_findings(complaints: Iterable[Complaint]) -> Iterator[Finding]:
    """
    Report each component of a robot whose diagnostic status is not OK.

    Parameters
    ----------
    complaints
        The newest status of each component whose level is WARN or worse.

    Yields
    ------
    Finding
        A warning for the level WARN, an error for all that are worse.

    """
    for each in complaints:
        yield Finding(
            Severity.WARNING if each.level == WARN else Severity.ERROR,
            f"'{each.name}' says: {each.message}",
            'this part of the robot may not behave as expected',
            'watch it with: ros2 topic echo /diagnostics',
        )
