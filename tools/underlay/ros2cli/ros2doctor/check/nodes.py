# SPDX-License-Identifier: Apache-2.0
"""Check the running nodes: their names and namespaces, where they run, and their diagnostics."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator

from ros2doctor.api.extension import Finding, Report, Severity
from ros2doctor.check.graph import Endpoint, Graph, GraphCheck, GraphReport
from ros2doctor.check.listening import Complaint, WARN
from ros_environment.suggestions import listing

# Topics that robots share on purpose.
_COMMON = frozenset(
    ('/clock', '/diagnostics', '/parameter_events', '/rosout', '/tf', '/tf_static')
)
DEFAULT_DOMAIN = 0


class NodesCheck(GraphCheck):
    """Check of the names of the running nodes."""

    def category(self) -> str:
        """Return the category."""
        return 'nodes'

    def findings(self, graph: Graph) -> Iterator[Finding]:
        """
        Check for duplicate node names and for namespaces without effect.

        Parameters
        ----------
        graph
            As for `GraphCheck.findings`; its `nodes` and `endpoints` are examined.

        Yields
        ------
        Finding
            A warning each.

        """
        yield from name_findings(graph.nodes)
        yield from namespace_findings(graph.endpoints)


def name_findings(names: Iterable[str]) -> Iterator[Finding]:
    """
    Report duplicate node names.

    Parameters
    ----------
    names
        Full names, repeated for each node of that name.

    Yields
    ------
    Finding
        One warning for each name shared by several nodes.

    """
    for name, count in sorted(Counter(names).items()):
        last = name.rpartition('/')[2]
        if count > 1:
            yield Finding(
                Severity.WARNING,
                f"{count} nodes have the name '{name}'",
                'calls to its services and parameters reach any of them; often one is left over '
                'from an earlier start',
                f'stop the one that is not needed (pgrep -af {last} may show the processes), or '
                f'start it under another name: ros2 run ... --ros-args -r __node:={last}_2',
            )


def namespace_findings(endpoints: Iterable[Endpoint]) -> Iterator[Finding]:
    """
    Report absolute topic names on which nodes of several namespaces publish together.

    Topics that robots share on purpose, such as /tf and /clock, are not counted.

    Parameters
    ----------
    endpoints
        The publishers and subscriptions of all nodes; only publishers matter.

    Yields
    ------
    Finding
        One warning for each topic and name of a node (without its namespace).

    """
    namespaces: dict[tuple[str, str], set[str]] = defaultdict(set)
    for each in endpoints:
        namespace, _, name = each.node.rpartition('/')
        is_inside = not namespace or each.topic.startswith(f'{namespace}/')
        if each.is_publisher and not is_inside and each.topic not in _COMMON:
            namespaces[each.topic, name].add(namespace.lstrip('/'))
    for (topic, name), found in sorted(namespaces.items()):
        if len(found) > 1:
            yield _namespace_without_effect(topic, name, sorted(found))


def _namespace_without_effect(topic: str, name: str, namespaces: list[str]) -> Finding:
    several = f'{", ".join(namespaces[:-1])} and {namespaces[-1]}'
    return Finding(
        Severity.WARNING,
        f"the namespaces {several} have no effect on '{topic}' of '{name}'",
        f"a name that begins with '/' is absolute: all {len(namespaces)} nodes publish on one "
        'topic, and each subscription receives all of it',
        f"write '{topic.lstrip('/')}' in the node, which becomes "
        f"'/{namespaces[0]}{topic}'; without touching the node, remap it: "
        f'--ros-args -r {topic}:={topic.lstrip("/")}',
    )


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
                f'nodes of other machines are in domain {DEFAULT_DOMAIN}, which is the default '
                f'for everyone who has not chosen one: {listing(list(graph.elsewhere))}',
                "your commands may move someone else's robot, and theirs may move yours",
                'export ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST, or agree on a domain: '
                'export ROS_DOMAIN_ID=42',
            )


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
            f"'{each.name}' reports: {each.message}",
            'this part of the robot may not behave as expected',
            'watch it with: ros2 topic echo /diagnostics',
        )


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
