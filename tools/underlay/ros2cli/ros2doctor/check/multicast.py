# SPDX-License-Identifier: Apache-2.0
"""Evaluate on which interfaces nodes can announce themselves."""

from __future__ import annotations

from collections.abc import Iterator
import errno

from ros2cli.graph.interfaces import Interface
from ros2doctor.api.finding import Finding, Severity
from ros2doctor.facts.network import Network


def multicast_findings(facts: Network) -> Iterator[Finding]:
    """
    Report the network interfaces on which multicast does not work.

    Parameters
    ----------
    facts
        The interfaces and the result of the multicast test on each.

    Yields
    ------
    Finding
        One error if no interface delivers multicast, else a warning for each one that does not
        (other than the loopback), and one for a missing route.

    """
    tried = [each for each in facts.interfaces if each.name in facts.multicast]
    deaf = [each for each in tried if facts.multicast[each.name]]
    if tried and len(deaf) == len(tried):
        yield _nowhere(deaf, facts)
        return
    others = [each for each in tried if not each.is_loopback]
    for each in others:
        if each in deaf:
            yield _on_interface(each, facts.multicast[each.name])
    if others and not facts.has_multicast_route:
        yield _no_route(others)


def multicast_state(error: OSError | None) -> str:
    """
    Summarize whether multicast works.

    Parameters
    ----------
    error
        What `multicast_error` returned: None if multicast works, TimeoutError if nothing arrives.

    Returns
    -------
    str
        The summary, in lower case and without a period.

    """
    if error is None:
        return 'multicast works'
    reason = 'packets do not arrive' if isinstance(error, TimeoutError) else error.strerror
    return f'multicast does not work: {reason}'


def _nowhere(deaf: list[Interface], facts: Network) -> Finding:
    states = {each.name: multicast_state(facts.multicast[each.name]) for each in deaf}
    first = deaf[0]
    return Finding(
        Severity.ERROR,
        'no network interface delivers multicast '
        f'({", ".join(f"{name}: {state}" for name, state in states.items())})',
        'nodes announce themselves by multicast: they do not even find those on this machine',
        f'{_mend(first, facts.multicast[first.name])}, or do without other machines: '
        'export ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST',
    )


def _on_interface(interface: Interface, error: OSError | None) -> Finding:
    return Finding(
        Severity.WARNING,
        f"on the interface '{interface.name}' ({interface.address}), {multicast_state(error)}",
        'nodes announce themselves by multicast, so those behind it are not found',
        f'{_mend(interface, error)}, or name the other machine: export ROS_STATIC_PEERS=ADDRESS',
    )


def _no_route(interfaces: list[Interface]) -> Finding:
    names = ', '.join(each.name for each in interfaces)
    return Finding(
        Severity.WARNING,
        f'there is no route for multicast, neither a default one nor one of its own ({names})',
        'nodes announce themselves on the loopback only, so other machines do not find them',
        f'sudo ip route add 239.255.0.0/16 dev {interfaces[0].name}',
    )


def _mend(interface: Interface, error: OSError | None) -> str:
    if isinstance(error, TimeoutError):
        return 'allow it in the firewall: sudo ufw allow in proto udp to 224.0.0.0/4'
    if error is not None and error.errno == errno.ENOBUFS:
        return 'sudo sysctl net.ipv4.igmp_max_memberships=20'
    return f'sudo ip link set {interface.name} multicast on'
