# SPDX-License-Identifier: Apache-2.0
"""Read once which nodes run, for all checks of them, and check that nodes can start at all."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
import re
import subprocess
import sys
import time
from typing import Any

from ros2cli.graph.graph import Graph as ObservedGraph
from ros2doctor.api.extension import DoctorCheck, DoctorReport, Finding, Report, Result, Severity
from ros2doctor.check.listening import (
    CLOCK_TOPIC,
    Complaint,
    DiagnosticsListener,
    nodes_on_clock,
    Transform,
    TransformListener,
)
from ros2doctor.check.servers import why_no_graph
from ros2doctor.check.wheels import install_command

TRANSFORM_TIME_S = 1.0
DIAGNOSTICS_TIME_S = 1.5
"""Longer than a second, their usual publication period."""
PERIOD_S = 0.05
PROBE = 'import rclpy; rclpy.init(); rclpy.create_node("_ros2cli_probe"); rclpy.shutdown()'
PROBE_TIMEOUT_S = 30.0
ERROR_LINE = re.compile(r'[A-Za-z_.]*Error: ')


@dataclass(frozen=True)
class Endpoint:
    """
    A publisher or subscription.

    :param node: full name of its node
    :param qos: its quality of service, as rclpy describes it
    :param is_elsewhere: whether it is on another machine
    """

    topic: str
    node: str
    type_name: str
    is_publisher: bool
    qos: Any
    is_elsewhere: bool = False


@dataclass(frozen=True)
class Graph:
    """
    Facts about the running nodes.

    :param nodes: full names, repeated for each node of that name
    :param elsewhere: names of nodes that run on other machines
    :param domain_id: the ROS domain ID
    :param complaints: statuses on the `diagnostics` topics that are not OK
    :param without_clock: names of nodes that use /clock although it is not published
    """

    nodes: tuple[str, ...] = ()
    endpoints: tuple[Endpoint, ...] = ()
    transforms: tuple[Transform, ...] = ()
    elsewhere: tuple[str, ...] = ()
    domain_id: int = 0
    without_clock: tuple[str, ...] = ()
    complaints: tuple[Complaint, ...] = ()


@lru_cache(maxsize=1)
def read_graph() -> Graph:
    """Read the graph once, for all checks and reports."""
    from ros2cli.node.direct import DirectNode
    from ros2node.api import get_node_names

    if sys.stderr.isatty():
        print('Looking at the running nodes ...', file=sys.stderr)
    with DirectNode(None) as node:
        listener = TransformListener(node)
        known = node.graph
        endpoints = tuple(_endpoints(known))
        nodes = get_node_names(node=known, include_hidden_nodes=True)
        diagnostics = DiagnosticsListener(node)
        types = {each.topic: each.type_name for each in endpoints if each.is_publisher}
        listener.listen_to(types)
        diagnostics.listen_to(types)
        if diagnostics.is_listening:
            _spin(node, DIAGNOSTICS_TIME_S)
        elif listener.is_listening:
            _spin(node, TRANSFORM_TIME_S)
        return Graph(
            tuple(name.full_name for name in nodes),
            endpoints,
            tuple(listener.transforms),
            tuple(sorted({each.node for each in endpoints if each.is_elsewhere})),
            node.watch.domain_id,
            nodes_on_clock(node, _waiting_for_clock(endpoints)),
            tuple(diagnostics.complaints),
        )


def _waiting_for_clock(endpoints: Iterable[Endpoint]) -> list[str]:
    """Return the nodes that subscribe to /clock, if it is not published."""
    clock = [each for each in endpoints if each.topic == CLOCK_TOPIC]
    return [] if any(each.is_publisher for each in clock) else [each.node for each in clock]


def _spin(node: Any, duration_s: float) -> None:
    """Spin for a while to receive from the subscribed topics."""
    end = time.monotonic() + duration_s
    while time.monotonic() < end:
        node.spin_once(PERIOD_S)


def _endpoints(known: ObservedGraph) -> Iterator[Endpoint]:
    for topic, _ in known.get_topic_names_and_types():
        for info in known.get_publishers_info_by_topic(topic):
            yield _endpoint(known, topic, info, is_publisher=True)
        for info in known.get_subscriptions_info_by_topic(topic):
            yield _endpoint(known, topic, info, is_publisher=False)


def _endpoint(known: ObservedGraph, topic: str, info: Any, *, is_publisher: bool) -> Endpoint:
    return Endpoint(
        topic,
        f'{info.node_namespace.rstrip("/")}/{info.node_name}',
        info.topic_type,
        is_publisher,
        info.qos_profile,
        known.is_elsewhere(info),
    )


@lru_cache(maxsize=1)
def why_rclpy_does_not_start() -> str:
    """Return the last error of a process that uses rclpy, or '' if it succeeds."""
    try:
        result = subprocess.run(
            [sys.executable, '-c', PROBE],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            timeout=PROBE_TIMEOUT_S,
        )
    except subprocess.TimeoutExpired:
        return f'it has not started within {PROBE_TIMEOUT_S:g} s'
    if result.returncode == 0:
        return ''
    lines = result.stderr.decode(errors='replace').split('\n')
    said = [line.strip() for line in lines if line.strip()]
    errors = [line for line in said if ERROR_LINE.match(line)]
    return (errors or said or [f'its process ended with status {result.returncode}'])[-1]


class ClientLibraryCheck(DoctorCheck):
    """Check of rclpy by using it."""

    def category(self) -> str:
        """Return the category."""
        return 'rclpy'

    def check(self) -> Result:
        """Check whether nodes can start."""
        return Result(client_library_findings(why_rclpy_does_not_start(), install_command()))


def client_library_findings(why_not: str, install_again: str) -> Iterator[Finding]:
    """
    Report an error if rclpy does not start.

    Parameters
    ----------
    why_not
        The reason, as `why_rclpy_does_not_start` gives it; '' if rclpy starts.
    install_again
        The command that installs the wheels again, which the finding suggests.

    Yields
    ------
    Finding
        At most one.

    """
    if why_not:
        yield Finding(
            Severity.ERROR,
            f'rclpy does not start: {why_not}',
            'no Python node can start; the running nodes were not examined',
            f'fix the errors above first; if there are none: {install_again}',
        )


class GraphCheck(DoctorCheck):
    """
    Base class of a graph check.

    It is skipped if rclpy does not start, or no discovery server can be asked: both have checks.
    """

    def check(self) -> Result:
        """Check the graph."""
        if why_rclpy_does_not_start() or why_no_graph():
            return Result()
        return Result(self.findings(read_graph()))

    def findings(self, graph: Graph) -> Iterator[Finding]:
        """
        Check the graph of the running nodes.

        Parameters
        ----------
        graph
            The facts about the running nodes, which `read_graph` reads once for all checks.

        Yields
        ------
        Finding
            A problem.

        Raises
        ------
        NotImplementedError
            A subclass does not override it.

        """
        raise NotImplementedError(f'{type(self).__name__} does not implement findings()')


class GraphReport(DoctorReport):
    """Base class of a graph report; contains the reason if rclpy does not start."""

    TITLE = ''

    def report(self) -> Report:
        """Return the section."""
        report = Report(self.TITLE)
        why_not = why_rclpy_does_not_start() or why_no_graph()
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
