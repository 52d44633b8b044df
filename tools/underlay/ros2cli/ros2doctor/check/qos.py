# SPDX-License-Identifier: Apache-2.0
"""Check that all subscriptions receive from all publishers of their topic."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator
from typing import Any

from ros2doctor.api.extension import Finding, Report, Severity
from ros2doctor.check.graph import Endpoint, Graph, GraphCheck, GraphReport

Pair = tuple[Endpoint, Endpoint]


class QosCheck(GraphCheck):
    """Check of each pair of publisher and subscription, evaluated per node."""

    def category(self) -> str:
        """Return the category."""
        return 'qos'

    def findings(self, graph: Graph) -> Iterator[Finding]:
        """
        Check for incompatible publishers and subscriptions.

        Parameters
        ----------
        graph
            As for `GraphCheck.findings`; its `endpoints` are examined.

        Yields
        ------
        Finding
            As for `pair_findings`, each once.

        """
        yield from dict.fromkeys(pair_findings(graph.endpoints, why_incompatible))


def why_nothing_passes(publisher: Endpoint, subscription: Endpoint) -> str:
    """
    Explain why a subscription receives nothing from a publisher: its type or its QoS.

    Parameters
    ----------
    publisher, subscription
        Two endpoints of the same topic.

    Returns
    -------
    str
        The reason; '' if messages pass.

    """
    if publisher.type_name != subscription.type_name:
        return f'{publisher.type_name} is not {subscription.type_name}'
    return why_incompatible(publisher.qos, subscription.qos)


def why_incompatible(offered: Any, requested: Any) -> str:
    """
    Explain why two QoS profiles are incompatible, as rclpy sees it.

    Parameters
    ----------
    offered
        The profile of the publisher.
    requested
        The profile of the subscription.

    Returns
    -------
    str
        The reason; '' if they are compatible, or may be.

    """
    from rclpy.qos import qos_check_compatible, QoSCompatibility

    compatibility, reason = qos_check_compatible(offered, requested)
    if compatibility != QoSCompatibility.ERROR:
        return ''
    return str(reason).removeprefix('ERROR: ').rstrip(';. ')


def pair_findings(
    endpoints: Iterable[Endpoint], why_not: Callable[[Any, Any], str]
) -> Iterator[Finding]:
    """
    Report the pairs of nodes with incompatible endpoints.

    A node may subscribe to a topic twice, with QoS profiles that complement each other: a
    publisher that reaches one of the subscriptions reaches the node.

    Parameters
    ----------
    endpoints
        The publishers and subscriptions of all nodes.
    why_not
        Accepts the offered and the requested QoS, and returns why they are incompatible, or ''
        if they are not; see `why_incompatible`.

    Yields
    ------
    Finding
        An error for each pair whose types or QoS do not match.

    """
    known = tuple(endpoints)
    findings, connected = [], set()
    for publisher, subscription in pairs(known):
        ends = (publisher.topic, publisher.node, subscription.node)
        if publisher.type_name != subscription.type_name:
            findings.append((ends, _other_type(publisher, subscription)))
        elif reason := why_not(publisher.qos, subscription.qos):
            findings.append((ends, _other_qos(publisher, subscription, reason)))
        else:
            connected.add(ends)
    yield from (finding for ends, finding in findings if ends not in connected)


def pairs(endpoints: Iterable[Endpoint]) -> Iterator[Pair]:
    """
    Pair each publisher with each subscription of its topic.

    Parameters
    ----------
    endpoints
        The publishers and subscriptions of all nodes.

    Yields
    ------
    tuple
        A publisher and a subscription, sorted by topic.

    """
    by_topic: dict[str, tuple[list[Endpoint], list[Endpoint]]] = defaultdict(lambda: ([], []))
    for endpoint in endpoints:
        by_topic[endpoint.topic][not endpoint.is_publisher].append(endpoint)
    for _, (publishers, subscriptions) in sorted(by_topic.items()):
        for publisher in publishers:
            yield from ((publisher, subscription) for subscription in subscriptions)


def _other_type(publisher: Endpoint, subscription: Endpoint) -> Finding:
    return Finding(
        Severity.ERROR,
        f"on '{publisher.topic}', '{publisher.node}' publishes {publisher.type_name}, but "
        f"'{subscription.node}' subscribes to {subscription.type_name}",
        f"'{subscription.node}' receives none of it, without any error message",
        'use one type in both nodes, or remap one of the topics: --ros-args -r '
        f'{publisher.topic}:=/another_name',
    )


def _other_qos(publisher: Endpoint, subscription: Endpoint, reason: str) -> Finding:
    return Finding(
        Severity.ERROR,
        f"on '{publisher.topic}', the QoS that '{publisher.node}' offers does not satisfy "
        f"'{subscription.node}' ({reason})",
        f"'{subscription.node}' receives nothing from '{publisher.node}', without any error",
        "give both the same QoS profile: the subscription may request less ('best effort', "
        "'volatile'), or the publisher offer more. To see both: "
        f'ros2 topic info --verbose {publisher.topic}',
    )


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
