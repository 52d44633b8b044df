# SPDX-License-Identifier: Apache-2.0
"""
The DDS participants on this machine, and which of them will answer.

RTPS gives each participant of a domain two UDP ports of its own. The kernel lists the open ports,
which is exact and takes no time, unlike waiting for answers. The processes of those that do not
answer are inspected.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from contextlib import suppress
import os
from typing import NamedTuple

from ros2cli.graph.reach import OFF
from ros2cli.rtps.identifiers import unicast_ports
from ros2cli.rtps.parameters import Address, THIS_HOST

SILENCE_S = 0.4  # after which inspecting all processes costs less than waiting longer
AGAIN_S = 2.0
LOCAL_ADDRESS_COLUMN = 1
INODE_COLUMN = 9
DDS_THREAD_PREFIX = 'dds.'
DISCOVERY_IS_OFF = f'ROS_AUTOMATIC_DISCOVERY_RANGE={OFF}'
READS = 3
PAGE_BYTES = 4096 - 256  # less than two rows
STOPPED_STATES = ('T', 't')  # by a signal, or by a debugger


class Census:
    """
    Counts the DDS participants of a domain on this machine from the kernel's socket table.

    Parameters
    ----------
    domain_id
        The ROS domain ID.

    """

    def __init__(self, domain_id: int) -> None:
        self._domain_id = domain_id
        self._sockets: dict[int, str] = {}
        self._since_s: dict[str, float] = {}
        self._holders: dict[str, Holder | None] = {}
        self._again_s = 0.0

    def take(self, now_s: float, silent: Collection[Address]) -> dict[Address, str] | None:
        """
        Count the participants of other processes on this machine.

        Participants that do not answer for 0.4 s are left out if their process will never answer.

        Parameters
        ----------
        now_s
            The current time of a monotonic clock, in s.
        silent
            The addresses of the last count that have not answered yet.

        Returns
        -------
        dict of Address to str, or None
            The inode of the socket at each address, which distinguishes a participant from a
            later one at the same address; None if they cannot be counted.

        """
        sockets = participant_sockets(self._domain_id)
        if sockets is None:
            return None
        self._sockets = sockets
        self._since_s = {
            inode: self._since_s.get(inode, now_s) for inode in self._sockets.values()
        }
        self._examine(now_s, silent)
        return {
            (THIS_HOST, port): inode for port, inode in sockets.items() if self._may_answer(inode)
        }

    def are_stopped(self, silent: Collection[Address]) -> bool:
        """
        Whether all unresponsive participants are stopped processes, so that waiting is futile.

        Parameters
        ----------
        silent
            The addresses of the participants; False if there are none.

        """
        holders = [self._holders.get(self._sockets.get(port, '')) for _, port in silent]
        return bool(holders) and all(holder and holder.is_stopped for holder in holders)

    def _examine(self, now_s: float, silent: Collection[Address]) -> None:
        """Find the processes of silent participants; recheck excluded ones periodically."""
        inodes = {self._sockets.get(port, '') for _, port in silent} & self._since_s.keys()
        doubtful = {inode for inode in inodes if now_s - self._since_s[inode] >= SILENCE_S}
        if doubtful - self._holders.keys() or now_s >= self._again_s:
            strangers = {inode for inode in self._since_s if not self._may_answer(inode)}
            found = find_holders(doubtful | strangers) if doubtful | strangers else {}
            self._holders = {inode: found.get(inode) for inode in doubtful | strangers}
            self._again_s = now_s + AGAIN_S

    def _may_answer(self, inode: str) -> bool:
        """Whether a socket may belong to a discoverable participant."""
        holder = self._holders.get(inode)
        return holder is None or holder.may_answer


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
    table = _read_table()
    return None if table is None else ports_in_table(*table, domain_id)


def foreign_ports() -> set[int] | None:
    """
    Return the UDP ports that other processes on this machine have open.

    Returns
    -------
    set of int or None
        The ports; None if the kernel does not provide them.

    """
    table = _read_table()
    return None if table is None else set(_sockets(*table))


def _read_table() -> tuple[list[str], set[str]] | None:
    """Read the kernel's table of UDP sockets, and the inodes of this process's sockets."""
    try:
        return _rows(), set(_own_sockets())
    except OSError:
        return None


def _rows(table: str = '/proc/net/udp') -> list[str]:
    """
    Return the rows of the kernel's table; those of sockets just closed may be among them.

    The kernel hands out a page at a time and counts rows to find the next one: if a socket has
    been closed in between, it skips another. So a table of several pages is read several times.
    """
    rows: dict[str, None] = {}
    for _ in range(READS):
        with open(table, encoding='ascii') as stream:
            text = stream.read()
        rows |= dict.fromkeys(text.splitlines()[1:])
        if len(text) < PAGE_BYTES:
            break
    return list(rows)


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
    found = _sockets(rows, own_inodes)
    ports = unicast_ports(domain_id)
    return {port: found[port] for port in ports if port in found and port + 1 in found}


def _sockets(rows: Iterable[str], own_inodes: set[str]) -> dict[int, str]:
    """Return the inodes of the sockets of other processes by UDP port."""
    found = {}
    for row in rows:
        columns = row.split()
        if columns[INODE_COLUMN] not in own_inodes:
            port = int(columns[LOCAL_ADDRESS_COLUMN].partition(':')[2], 16)
            found[port] = columns[INODE_COLUMN]
    return found


def _own_sockets() -> Iterator[str]:
    """Yield the inodes of this process's sockets."""
    for descriptor in os.listdir('/proc/self/fd'):
        try:
            target = os.readlink(f'/proc/self/fd/{descriptor}')
        except OSError:
            continue
        if target.startswith('socket:['):
            yield target.removeprefix('socket:[').removesuffix(']')


class Holder(NamedTuple):
    """
    A process that holds a socket.

    :param may_answer: whether it has Fast DDS threads, or its threads are not visible, and its
        discovery is not turned off
    :param is_stopped: whether it cannot answer until it is continued
    """

    pid: int
    may_answer: bool
    is_stopped: bool


def find_holders(inodes: Collection[str], proc: str = '/proc') -> dict[str, Holder]:
    """
    Find the processes that hold sockets; those of other users cannot be found.

    A child that has inherited a participant's socket counts only if no other process holds it.

    Parameters
    ----------
    inodes
        The inodes of the sockets, in decimal.
    proc
        The mount point of procfs.

    Returns
    -------
    dict of str to Holder
        One process per inode, as far as they are found.

    """
    targets = {f'socket:[{inode}]': inode for inode in inodes}
    found: dict[str, Holder] = {}
    for pid in filter(str.isdecimal, os.listdir(proc)):
        for target in _descriptors(f'{proc}/{pid}/fd'):
            inode = targets.get(target)
            if inode and not (inode in found and found[inode].may_answer):
                found[inode] = _holder(proc, pid)
    return found


def _descriptors(folder: str) -> Iterator[str]:
    """Yield the targets of a process's descriptors; none if it is inaccessible or has exited."""
    with suppress(OSError):
        for descriptor in os.listdir(folder):
            with suppress(OSError):
                yield os.readlink(f'{folder}/{descriptor}')


def _holder(proc: str, pid: str) -> Holder:
    names: list[str] = []
    with suppress(OSError):
        tasks = os.listdir(f'{proc}/{pid}/task')
        names = [_read(f'{proc}/{pid}/task/{task}/comm') for task in tasks]
    is_participant = not names or any(name.startswith(DDS_THREAD_PREFIX) for name in names)
    is_off = DISCOVERY_IS_OFF in _read(f'{proc}/{pid}/environ').split('\0')
    state = _read(f'{proc}/{pid}/stat').rpartition(') ')[2][:1]
    return Holder(int(pid), is_participant and not is_off, state in STOPPED_STATES)


def _read(path: str) -> str:
    try:
        with open(path, encoding='utf-8', errors='replace') as stream:
            return stream.read()
    except OSError:
        return ''
