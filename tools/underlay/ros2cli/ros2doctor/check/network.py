# SPDX-License-Identifier: Apache-2.0
"""Check that nodes can find each other."""

from __future__ import annotations

from collections.abc import Iterator
import os

from ros2cli.graph.reach import LOCALHOST, MAX_DOMAIN_ID, OFF, SUBNET, SYSTEM_DEFAULT
from ros2cli.rtps.identifiers import multicast_port, PORT_BASE, PORTS_PER_DOMAIN
from ros2doctor.api.extension import DoctorCheck
from ros2doctor.api.finding import Finding, Result, Severity
from ros2doctor.check.multicast import multicast_findings
from ros2doctor.check.shared_memory import shared_memory_findings
from ros2doctor.facts.network import Network, read_network

RANGES = (SUBNET, LOCALHOST, OFF, SYSTEM_DEFAULT)
WITH_MULTICAST = (SUBNET, SYSTEM_DEFAULT)
PROFILES_VARIABLE = 'FASTRTPS_DEFAULT_PROFILES_FILE'
OWN_PROFILE = os.path.join('share', 'ros_environment', 'config', 'fastdds.xml')
PEERS_VARIABLE, SERVER_VARIABLE = 'ROS_STATIC_PEERS', 'ROS_DISCOVERY_SERVER'


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
        return f'whoever {profile} lets in' if profile else 'every machine in the network'
    return 'this machine only' if extent == LOCALHOST else 'every machine in the network'


def _range(facts: Network) -> Iterator[Finding]:
    found = discovery_range(facts)
    if found not in RANGES:
        yield Finding(
            Severity.ERROR,
            f"ROS_AUTOMATIC_DISCOVERY_RANGE is '{found}', which is none of {', '.join(RANGES)}",
            'nodes look for others on this machine only, as with LOCALHOST, but their DDS profile '
            'is not read with it, so that other machines still reach them',
            'export ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET, or LOCALHOST',
        )
    elif found == OFF:
        yield Finding(
            Severity.WARNING,
            'ROS_AUTOMATIC_DISCOVERY_RANGE is OFF',
            'nodes find no others, not even on this machine',
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
    for name in (PEERS_VARIABLE, SERVER_VARIABLE):
        others = [host for host in _hosts(facts.variables.get(name, '')) if not _is_here(host)]
        if others:
            yield Finding(
                Severity.WARNING,
                f"{name} names '{others[0]}', but ROS_AUTOMATIC_DISCOVERY_RANGE is LOCALHOST",
                'nodes are on the loopback interface only: they reach no other machine, and none '
                'reaches them',
                f'export ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET, or: unset {name}',
            )


def _hosts(text: str) -> list[str]:
    """Return the hosts of a list like ROS_STATIC_PEERS, or with ports as for discovery servers."""
    return [each.strip().rpartition(':')[0] or each.strip() for each in text.split(';') if each]


def _is_here(host: str) -> bool:
    return host == 'localhost' or host.startswith('127.')


def _domain(facts: Network) -> Iterator[Finding]:
    text = facts.variables.get('ROS_DOMAIN_ID') or '0'
    if not text.isdigit() or int(text) > MAX_DOMAIN_ID:
        yield Finding(
            Severity.ERROR,
            f"ROS_DOMAIN_ID is '{text}', which is no whole number from 0 to {MAX_DOMAIN_ID}",
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
            f'the ports of domain {text} begin at {port}, among those that the kernel gives to '
            f'any program ({first} to {last})',
            'now and then a node cannot start, or is not found, because its port is taken',
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
    elif discovery_range(facts) in WITH_MULTICAST:
        yield from multicast_findings(facts)


def _profiles(facts: Network) -> Iterator[Finding]:
    path = facts.variables.get(PROFILES_VARIABLE, '')
    if path and not os.path.isfile(path):
        yield Finding(
            Severity.WARNING,
            f"{PROFILES_VARIABLE} names '{path}', which does not exist",
            'nodes run with the defaults of DDS, with which camera images get lost',
            f'unset {PROFILES_VARIABLE}, then source the environment again',
        )
