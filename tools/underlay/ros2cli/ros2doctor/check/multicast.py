# SPDX-License-Identifier: Apache-2.0
"""Check on which interfaces nodes can announce themselves; nothing leaves this machine."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
import errno
import os
import socket

from ros2cli.graph.reach import Interface
from ros2doctor.api.extension import Finding, Severity

DDS_GROUP = '239.255.0.1'
DDS_PORT = 7400
TIMEOUT_S = 0.5
STAYS_HERE = 0
TOKEN_BYTES = 8


def multicast_error(address: str) -> OSError | None:
    """
    Test whether an interface delivers multicast, with a packet to the DDS discovery group.

    The packet does not leave this machine.

    Parameters
    ----------
    address
        The IPv4 address of the interface.

    Returns
    -------
    OSError or None
        None if the packet came back, TimeoutError if not within 0.5 s, else the error.

    """
    try:
        with _receiver(address) as receiver, _sender(address) as sender:
            sender.sendto(os.urandom(TOKEN_BYTES), (DDS_GROUP, receiver.getsockname()[1]))
            receiver.recv(TOKEN_BYTES)
    except OSError as error:
        return error
    return None


def has_multicast_route() -> bool:
    """Whether the kernel has a route to the DDS multicast group; nothing is sent."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as asked:
        try:
            asked.connect((DDS_GROUP, DDS_PORT))
        except OSError:
            return False
    return True


def _receiver(address: str) -> socket.socket:
    receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    try:
        receiver.bind(('', 0))
        receiver.settimeout(TIMEOUT_S)
        membership = socket.inet_aton(DDS_GROUP) + socket.inet_aton(address)
        receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, membership)
    except OSError:
        receiver.close()
        raise
    return receiver


def _sender(address: str) -> socket.socket:
    sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    try:
        interface = socket.inet_aton(address)
        sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, interface)
        sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, STAYS_HERE)
        sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_LOOP, 1)
    except OSError:
        sender.close()
        raise
    return sender


def multicast_findings(
    interfaces: Iterable[Interface], errors: Mapping[str, OSError | None], has_route: bool
) -> Iterator[Finding]:
    """
    Report the network interfaces on which multicast does not work.

    Parameters
    ----------
    interfaces
        All network interfaces.
    errors
        What `multicast_error` returned for each interface that was tested, by its name.
    has_route
        Whether there is a route for multicast.

    Yields
    ------
    Finding
        One error if no interface delivers multicast, else a warning for each one that does not
        (other than the loopback), and one for a missing route.

    """
    tried = [each for each in interfaces if each.name in errors]
    deaf = [each for each in tried if errors[each.name]]
    if tried and len(deaf) == len(tried):
        yield _nowhere(deaf, errors)
        return
    others = [each for each in tried if not each.is_loopback]
    for each in others:
        if each in deaf:
            yield _on_interface(each, errors[each.name])
    if others and not has_route:
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


def _nowhere(deaf: list[Interface], errors: Mapping[str, OSError | None]) -> Finding:
    states = {each.name: multicast_state(errors[each.name]) for each in deaf}
    first = deaf[0]
    return Finding(
        Severity.ERROR,
        'no network interface delivers multicast '
        f'({", ".join(f"{name}: {state}" for name, state in states.items())})',
        'nodes announce themselves by multicast: they do not even find those on this machine',
        f'{_mend(first, errors[first.name])}, or do without other machines: '
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
