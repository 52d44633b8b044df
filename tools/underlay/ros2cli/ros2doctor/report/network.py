# SPDX-License-Identifier: Apache-2.0
"""The network."""

from __future__ import annotations

from ros2cli.graph.interfaces import Interface
from ros2doctor.api.extension import DoctorReport
from ros2doctor.api.report import Report
from ros2doctor.check.multicast import multicast_state
from ros2doctor.check.network import discovery_range, who_reaches
from ros2doctor.facts.network import Network, read_network


class NetworkReport(DoctorReport):
    """Report of interfaces and discovery."""

    def category(self) -> str:
        """Return the category."""
        return 'network'

    def report(self) -> Report:
        """Return the section."""
        facts = read_network()
        report = Report('NETWORK CONFIGURATION')
        variables = facts.variables
        report.add_to_report('discovery range', discovery_range(facts))
        report.add_to_report('nodes are reached by', who_reaches(facts))
        report.add_to_report('domain', variables.get('ROS_DOMAIN_ID') or '0')
        report.add_to_report('static peers', variables.get('ROS_STATIC_PEERS', ''))
        report.add_to_report('middleware', variables.get('RMW_IMPLEMENTATION', ''))
        memory = facts.shared_memory
        report.add_to_report('bytes free in /dev/shm', memory and memory.free)
        report.add_to_report('bytes of killed processes', memory and memory.orphan_bytes)
        report.add_to_report('multicast', 'routed' if facts.has_multicast_route else 'no route')
        for interface in facts.interfaces:
            report.add_to_report(interface.name, _state(facts, interface))
        return report


def _state(facts: Network, interface: Interface) -> str:
    words = [interface.address or 'no IPv4 address', 'up' if interface.is_up else 'down']
    if interface.name in facts.multicast:
        words.append(multicast_state(facts.multicast[interface.name]))
    return ', '.join(words)
