# SPDX-License-Identifier: Apache-2.0
"""
Find the DDS participants on this machine, whose answers can be expected.

RTPS gives each participant of a domain two UDP ports of its own. The kernel lists the open ports,
which is exact and takes no time, unlike waiting for answers.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
import os

from ros2cli.rtps.identifiers import unicast_ports

LOCAL_ADDRESS_COLUMN = 1
INODE_COLUMN = 9


def participant_ports(domain_id: int) -> list[int] | None:
    """
    Return the discovery ports of other processes' participants.

    Parameters
    ----------
    domain_id
        The ROS domain ID.

    Returns
    -------
    list of int or None
        UDP ports, ascending; None if the kernel does not provide them.

    """
    sockets = participant_sockets(domain_id)
    return None if sockets is None else list(sockets)


def participant_sockets(domain_id: int) -> dict[int, str] | None:
    """
    Return the discovery ports of other processes' participants with their sockets.

    Parameters
    ----------
    domain_id
        The ROS domain ID.

    Returns
    -------
    dict of int to str, or None
        The inodes of the sockets by UDP port; None if the kernel does not provide them.

    """
    try:
        with open('/proc/net/udp', encoding='ascii') as stream:
            rows = stream.readlines()[1:]
        own = set(_own_sockets())
    except OSError:
        return None
    return ports_in_table(rows, own, domain_id)


def ports_in_table(rows: Iterable[str], own_inodes: set[str], domain_id: int) -> dict[int, str]:
    """
    Find the discovery ports in the kernel's table of UDP sockets.

    Parameters
    ----------
    rows
        The lines of `/proc/net/udp`, without the header.
    own_inodes
        The inodes of this process's sockets, which are left out.
    domain_id
        The ROS domain ID.

    Returns
    -------
    dict of int to str
        The inodes of the sockets by UDP port, ascending.

    """
    found = {}
    for row in rows:
        columns = row.split()
        if columns[INODE_COLUMN] not in own_inodes:
            port = int(columns[LOCAL_ADDRESS_COLUMN].partition(':')[2], 16)
            found[port] = columns[INODE_COLUMN]
    ports = unicast_ports(domain_id)
    return {port: found[port] for port in ports if port in found and port + 1 in found}


def _own_sockets() -> Iterator[str]:
    """Yield the inodes of this process's sockets."""
    for descriptor in os.listdir('/proc/self/fd'):
        try:
            target = os.readlink(f'/proc/self/fd/{descriptor}')
        except OSError:
            continue
        if target.startswith('socket:['):
            yield target.removeprefix('socket:[').removesuffix(']')
