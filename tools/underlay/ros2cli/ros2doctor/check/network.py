# SPDX-License-Identifier: Apache-2.0
"""Check that nodes can find each other."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
import os
from pathlib import Path

from ros2cli.graph.reach import (
    Interface,
    LOCALHOST,
    MAX_DOMAIN_ID,
    OFF,
    read_interfaces,
    SUBNET,
    SYSTEM_DEFAULT,
)
from ros2cli.graph.servers import is_loopback, read_servers
from ros2cli.rtps.identifiers import multicast_port, PORT_BASE, PORTS_PER_DOMAIN
from ros2doctor.api.extension import DoctorCheck, DoctorReport, Finding, Report, Result, Severity
from ros2doctor.check.transports import (
    has_multicast_route,
    multicast_error,
    multicast_findings,
    multicast_state,
    read_shared_memory,
    shared_memory_findings,
    SharedMemory,
)

PORT_RANGE = Path('/proc/sys/net/ipv4/ip_local_port_range')
USUAL_PORT_RANGE = (32768, 60999)
RANGES = (SUBNET, LOCALHOST, OFF, SYSTEM_DEFAULT)
WITH_MULTICAST = (SUBNET, SYSTEM_DEFAULT)
PROFILES_VARIABLE = 'FASTRTPS_DEFAULT_PROFILES_FILE'
OWN_PROFILE = os.path.join('share', 'ros_environment', 'config', 'fastdds.xml')
PEERS_VARIABLE, SERVER_VARIABLE = 'ROS_STATIC_PEERS', 'ROS_DISCOVERY_SERVER'


@dataclass(frozen=True)
class Network:
    """
    Facts that discovery depends on.

    :param multicast: why multicast is not delivered, if it is not, by name of interface
    :param has_multicast_route: whether it has a route if no interface is named, as in Fast DDS
    :param ephemeral_ports: the range of ports that the kernel assigns automatically
    :param shared_memory: the shared memory for messages on this machine; None without any
    """

    variables: Mapping[str, str]
    interfaces: tuple[Interface, ...]
    multicast: Mapping[str, OSError | None]
    has_multicast_route: bool
    ephemeral_ports: tuple[int, int]
    shared_memory: SharedMemory | None


def read_network() -> Network:
    """Return the network facts of this process."""
    interfaces = tuple(read_interfaces())
    return Network(
        variables=dict(os.environ),
        interfaces=interfaces,
        multicast={
            each.name: multicast_error(each.address)
            for each in interfaces
            if each.is_up and each.address
        },
        has_multicast_route=has_multicast_route(),
        ephemeral_ports=_ephemeral_ports(),
        shared_memory=read_shared_memory(),
    )


def _ephemeral_ports() -> tuple[int, int]:
    try:
        first, last = PORT_RANGE.read_text(encoding='ascii').split()
    except (OSError, ValueError):
        return USUAL_PORT_RANGE
    return int(first), int(last)


class NetworkCheck(DoctorCheck):
    """Check of the network."""

    def category(self) -> str:
        """Return the category."""
        return 'network'

    def check(self) -> Result:
        """Check for problems that prevent discovery."""
        return Result(network_findings(read_network()))


def network_findings(facts: Network) -> Iterator[Finding]:
    """
    Report problems that prevent discovery or message delivery.

    Discovery range, static peers, domain, interfaces, multicast, DDS profile and shared memory are
    examined.

    Parameters
    ----------
    facts
        The configuration of the network, as `read_network` gives it.

    Yields
    ------
    Finding
        An error or a warning each.

    """
    yield from _range(facts)
    yield from _peers(facts)
    yield from _domain(facts)
    yield from _interfaces(facts)
    yield from _profiles(facts)
    yield from shared_memory_findings(facts.shared_memory)


def discovery_range(facts: Network) -> str:
    """
    Get the discovery range that nodes use, SUBNET by default.

    Parameters
    ----------
    facts
        The network, of whose variables ROS_AUTOMATIC_DISCOVERY_RANGE is read.

    Returns
    -------
    str
        The value as set, which may be unknown to ROS.

    """
    return facts.variables.get('ROS_AUTOMATIC_DISCOVERY_RANGE', '') or SUBNET


def who_reaches(facts: Network) -> str:
    """
    Describe which machines reach the nodes that are started here.

    Parameters
    ----------
    facts
        The network, whose discovery range and DDS profile decide.

    Returns
    -------
    str
        A phrase such as `this machine only`.

    """
    profile = facts.variables.get(PROFILES_VARIABLE, '')
    extent = discovery_range(facts)
    if extent == OFF:
        return 'nobody'
    if not profile.endswith(OWN_PROFILE):
        return f'the machines that {profile} allows' if profile else 'every machine in the network'
    return 'this machine only' if extent == LOCALHOST else 'every machine in the network'


def _range(facts: Network) -> Iterator[Finding]:
    found = discovery_range(facts)
    if found not in RANGES:
        yield Finding(
            Severity.ERROR,
            f"ROS_AUTOMATIC_DISCOVERY_RANGE is '{found}', which is not one of {', '.join(RANGES)}",
            'nodes look for others on this machine only, as with LOCALHOST, but their DDS profile '
            'is not read with it, so that other machines still reach them',
            'export ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET, or LOCALHOST',
        )
    elif found == OFF:
        yield Finding(
            Severity.WARNING,
            'ROS_AUTOMATIC_DISCOVERY_RANGE is OFF',
            'nodes do not find each other, not even on this machine',
            'export ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST',
        )
    if facts.variables.get('ROS_LOCALHOST_ONLY', '0') not in ('', '0'):
        yield Finding(
            Severity.WARNING,
            'ROS_LOCALHOST_ONLY is set, which is deprecated',
            'it overrides ROS_AUTOMATIC_DISCOVERY_RANGE and ROS_STATIC_PEERS, but only the former '
            'keeps other machines from reaching the nodes',
            'unset ROS_LOCALHOST_ONLY; export ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST',
        )


def _peers(facts: Network) -> Iterator[Finding]:
    """Yield the settings that name other machines although no socket is open to them."""
    if discovery_range(facts) != LOCALHOST:
        return
    peers = [each.strip() for each in facts.variables.get(PEERS_VARIABLE, '').split(';')]
    named = {PEERS_VARIABLE: peers, SERVER_VARIABLE: _server_hosts(facts.variables)}
    for name, hosts in named.items():
        others = [host for host in hosts if host and not is_loopback(host)]
        if others:
            yield Finding(
                Severity.WARNING,
                f"{name} names '{others[0]}', but ROS_AUTOMATIC_DISCOVERY_RANGE is LOCALHOST",
                'nodes are on the loopback interface only: they reach no other machine, and none '
                'reaches them',
                f'export ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET, or: unset {name}',
            )


def _server_hosts(variables: Mapping[str, str]) -> list[str]:
    """Return the hosts of the discovery servers; none if the list has a mistake."""
    try:
        return [each.host for each in read_servers(variables)]
    except RuntimeError:  # which the check of the servers reports
        return []


def _domain(facts: Network) -> Iterator[Finding]:
    text = facts.variables.get('ROS_DOMAIN_ID') or '0'
    if not text.isdecimal() or int(text) > MAX_DOMAIN_ID:
        yield Finding(
            Severity.ERROR,
            f"ROS_DOMAIN_ID is '{text}', which is not a whole number from 0 to {MAX_DOMAIN_ID}",
            'no node can start',
            'export ROS_DOMAIN_ID=0',
        )
        return
    first, last = facts.ephemeral_ports
    port = multicast_port(int(text))
    if first <= port + PORTS_PER_DOMAIN and port <= last:
        safe = (first - PORT_BASE) // PORTS_PER_DOMAIN - 1
        yield Finding(
            Severity.WARNING,
            f'the ports of domain {text} start at {port}, among the ephemeral ports that the '
            f'kernel gives to any program ({first} to {last})',
            'occasionally a node cannot start, or is not found, because its port is taken',
            f'export ROS_DOMAIN_ID={min(int(text) % 100, safe)}',
        )


def _interfaces(facts: Network) -> Iterator[Finding]:
    usable = [each for each in facts.interfaces if each.is_loopback and each.is_up]
    if not any(each.address for each in usable):
        yield Finding(
            Severity.ERROR,
            'the loopback interface has no address'
            if usable
            else 'the loopback interface is down',
            'nodes on this machine do not find each other',
            'sudo ip addr add 127.0.0.1/8 dev lo' if usable else 'sudo ip link set lo up',
        )
    elif discovery_range(facts) in WITH_MULTICAST and not facts.variables.get(SERVER_VARIABLE):
        yield from multicast_findings(facts.interfaces, facts.multicast, facts.has_multicast_route)


def _profiles(facts: Network) -> Iterator[Finding]:
    path = facts.variables.get(PROFILES_VARIABLE, '')
    if path and not os.path.isfile(path):
        yield Finding(
            Severity.WARNING,
            f"{PROFILES_VARIABLE} names '{path}', which does not exist",
            'nodes run with the defaults of DDS, with which camera images get lost',
            f'unset {PROFILES_VARIABLE}, then source the environment again',
        )


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
