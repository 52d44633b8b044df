# SPDX-License-Identifier: Apache-2.0
"""Check that nodes on other machines are visible on purpose."""

from __future__ import annotations

from collections.abc import Iterator

from ros2doctor.api.finding import Finding, Severity
from ros2doctor.check.graph_check import GraphCheck
from ros2doctor.facts.graph import Graph
from ros_environment.advice import listing

DEFAULT_DOMAIN = 0


class NeighboursCheck(GraphCheck):
    """Check of the nodes on other machines."""

    def category(self) -> str:
        """Return the category."""
        return 'neighbours'

    def findings(self, graph: Graph) -> Iterator[Finding]:
        """
        Check for nodes on other machines in the default domain.

        Parameters
        ----------
        graph
            As for `GraphCheck.findings`; its `elsewhere` and `domain_id` are examined.

        Yields
        ------
        Finding
            At most one warning, which names all these nodes.

        """
        if graph.elsewhere and graph.domain_id == DEFAULT_DOMAIN:
            yield Finding(
                Severity.WARNING,
                f'nodes of other machines are in domain {DEFAULT_DOMAIN}, which everybody has '
                f'who has not chosen one: {listing(list(graph.elsewhere))}',
                'your commands may move the robot of a neighbour, and theirs may move yours',
                'export ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST, or agree on a domain: '
                'export ROS_DOMAIN_ID=42',
            )
