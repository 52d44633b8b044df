# SPDX-License-Identifier: Apache-2.0
"""
Check the transports of DDS: multicast on each interface, and shared memory on this machine.

What is sent to test multicast does not leave this machine.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
import errno
import fcntl
import os
from pathlib import Path
import shutil
import socket

from ros2cli.graph.reach import Interface
from ros2doctor.api.extension import Finding, Severity

DDS_GROUP = '239.255.0.1'
DDS_PORT = 7400
TIMEOUT_S = 0.5
STAYS_HERE = 0
TOKEN_BYTES = 8
FOLDER = Path('/dev/shm')
LOCKS = 'fastrtps_[0-9a-f]*_el'  # locks of segments; those of ports differ
LOCK_SUFFIX = '_el'
BLOCK_BYTES = 512
ENOUGH_BYTES = 64 * 1000 * 1000
TOO_MANY_BYTES = 256 * 1000 * 1000
CLEAN_UP = 'for l in /dev/shm/fastrtps_[0-9a-f]*_el; do flock -n "$l" rm -f "$l" "${l%_el}"; done'


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


@dataclass(frozen=True)
class SharedMemory:
    """
    Shared memory usage, in bytes.

    :param free: the free space
    :param orphans: how many segments belong to processes that were killed
    :param orphan_bytes: the memory that these still occupy
    """

    free: int
    orphans: int = 0
    orphan_bytes: int = 0


def read_shared_memory(folder: Path = FOLDER) -> SharedMemory | None:
    """
    Measure the shared memory available to Fast DDS, and the orphans of killed processes.

    Parameters
    ----------
    folder
        The mount point of the shared memory.

    Returns
    -------
    SharedMemory or None
        None if the folder does not exist or cannot be written.

    """
    if not os.access(folder, os.W_OK):
        return None
    orphans = [lock for lock in sorted(folder.glob(LOCKS)) if _is_orphan(lock)]
    segments = [lock.with_name(lock.name.removesuffix(LOCK_SUFFIX)) for lock in orphans]
    return SharedMemory(
        shutil.disk_usage(folder).free, len(orphans), sum(_bytes(each) for each in segments)
    )


def _is_orphan(lock: Path) -> bool:
    """Whether no process holds the lock; Fast DDS locks each segment as long as it is used."""
    try:
        with lock.open('rb') as stream:
            fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True


def _bytes(segment: Path) -> int:
    try:
        return segment.stat().st_blocks * BLOCK_BYTES
    except OSError:
        return 0


def shared_memory_findings(facts: SharedMemory | None) -> Iterator[Finding]:
    """
    Report shared memory that is missing, almost full, or occupied by killed processes.

    Parameters
    ----------
    facts
        The state of /dev/shm; None if it does not exist or cannot be written.

    Yields
    ------
    Finding
        At most one warning.

    """
    if facts is None:
        yield _too_little('is missing or cannot be written', 'sudo mount -t tmpfs tmpfs /dev/shm')
    elif facts.free < ENOUGH_BYTES:
        mend = CLEAN_UP if facts.orphans else 'stop nodes that are not needed'
        yield _too_little(f'has {facts.free // 10**6} MB left', mend)
    elif facts.orphan_bytes > TOO_MANY_BYTES:
        yield Finding(
            Severity.WARNING,
            f'/dev/shm holds {facts.orphan_bytes // 10**6} MB of {facts.orphans} processes that '
            'were killed',
            'this memory is unused, but stays allocated until the machine restarts',
            CLEAN_UP,
        )


def _too_little(state: str, mend: str) -> Finding:
    return Finding(
        Severity.WARNING,
        f'/dev/shm {state}',
        'messages between processes of this machine go through it, several MB a node: nodes '
        'fail to start, or large messages get lost',
        f'{mend}; in a container: docker run --shm-size=1g',
    )
