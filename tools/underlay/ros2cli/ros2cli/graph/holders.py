# SPDX-License-Identifier: Apache-2.0
"""Find the processes that hold the sockets of unresponsive participants."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from contextlib import suppress
import os
from typing import NamedTuple

from ros2cli.graph.reach import OFF

DDS_THREAD_PREFIX = 'dds.'
DISCOVERY_IS_OFF = f'ROS_AUTOMATIC_DISCOVERY_RANGE={OFF}'
STOPPED_STATES = ('T', 't')  # by a signal, or by a debugger


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
