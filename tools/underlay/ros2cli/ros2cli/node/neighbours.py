# SPDX-License-Identifier: Apache-2.0
"""
Count the DDS participants on this machine, so that discovery knows when it is complete.

RTPS gives each participant of a domain a UDP port of its own: 7400 + 250 * domain + 10 + 2 * n.
The kernel lists the open ports, which is exact and takes no time, unlike waiting for answers.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
import os

PORT_BASE = 7400
PORTS_PER_DOMAIN = 250
FIRST_UNICAST_PORT = 10
MAX_PARTICIPANTS = 120
LOCAL_ADDRESS_COLUMN = 1
INODE_COLUMN = 9


def count_neighbours(domain_id: int) -> int | None:
    """Return how many other processes' participants are open; None where it is unknown."""
    try:
        with open('/proc/net/udp', encoding='ascii') as stream:
            rows = stream.readlines()[1:]
        own = set(_own_sockets())
    except OSError:
        return None
    return count_in_table(rows, own, domain_id)


def count_in_table(rows: Iterable[str], own_inodes: set[str], domain_id: int) -> int:
    """Count the participants in the kernel's table of UDP sockets, without our own."""
    first = PORT_BASE + PORTS_PER_DOMAIN * domain_id + FIRST_UNICAST_PORT
    ports = set(range(first, first + 2 * MAX_PARTICIPANTS, 2))
    found = set()
    for row in rows:
        columns = row.split()
        port = int(columns[LOCAL_ADDRESS_COLUMN].partition(':')[2], 16)
        if port in ports and columns[INODE_COLUMN] not in own_inodes:
            found.add(port)
    return len(found)


def _own_sockets() -> Iterator[str]:
    """Yield the inodes of this process's sockets."""
    for descriptor in os.listdir('/proc/self/fd'):
        try:
            target = os.readlink(f'/proc/self/fd/{descriptor}')
        except OSError:
            continue
        if target.startswith('socket:['):
            yield target.removeprefix('socket:[').removesuffix(']')
