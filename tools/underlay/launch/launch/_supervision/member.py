# SPDX-License-Identifier: Apache-2.0
"""
One process of a launch: its state in /proc, and how to send it a signal.

Imported only when there is a process to examine, which most launches avoid.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
import os
import signal
from typing import Optional


@dataclass(frozen=True)
class Member:
    """
    A process of a launch.

    :param start_ticks: the start time, in clock ticks since boot
    :param is_nested: whether it belongs to a launch that this one has started
    """

    pid: int
    parent: int
    group: int
    session: int
    start_ticks: int
    name: str
    is_nested: bool = False

    def of_launch(self, *, nested: bool) -> Member:
        """
        Copy the member, with whether it belongs to a nested launch.

        Parameters
        ----------
        nested
            Whether it belongs to a launch that this one has started.

        """
        return replace(self, is_nested=nested)

    def __str__(self) -> str:
        """Format the name and the process id for the log."""
        return f'{self.name} [{self.pid}]'


def look_at(pid: int) -> Optional[Member]:
    """
    Read the state of a process from /proc.

    Parameters
    ----------
    pid
        The id of the process.

    Returns
    -------
    Member or None
        The process, None if it has ended.

    """
    try:
        with open(f'/proc/{pid}/stat', 'rb') as file:
            head, _, tail = file.read().rpartition(b')')
    except OSError:
        return None
    fields = tail.split()
    if fields[0] in (b'Z', b'X') and int(fields[17]) < 2:  # its first thread may end before others
        return None
    parent, group, session = map(int, fields[1:4])
    name = head.partition(b'(')[2].decode('utf-8', 'replace')
    return Member(pid, parent, group, session, int(fields[19]), name)


def variables_of(pid: int) -> dict[str, str]:
    """
    Read the launch variables in the initial environment of a process from /proc.

    Parameters
    ----------
    pid
        The id of the process.

    Returns
    -------
    dict
        The variables whose names begin with `ROS_LAUNCH_`; empty if they cannot be read.

    """
    try:
        with open(f'/proc/{pid}/environ', 'rb') as file:
            items = file.read().split(b'\0')
    except OSError:
        return {}
    pairs = (os.fsdecode(item).partition('=') for item in items if item.startswith(b'ROS_LAUNCH_'))
    return {name: value for name, _, value in pairs}


def send(member: Member, number: signal.Signals) -> None:
    """
    Send a signal to a member, but never to another process that has reused its id.

    Parameters
    ----------
    member
        The process; nothing is done if it has exited or belongs to another user.
    number
        The signal.

    """
    try:
        descriptor = os.pidfd_open(member.pid)
    except ProcessLookupError:
        return
    except (AttributeError, OSError):  # an old system, or too many open files
        if is_alive(member):
            _send_quietly(os.kill, member.pid, number)
        return
    try:
        if is_alive(member):
            _send_quietly(signal.pidfd_send_signal, descriptor, number)
    finally:
        os.close(descriptor)


def _send_quietly(function: object, target: int, number: signal.Signals) -> None:
    try:
        function(target, number)  # type: ignore[operator]
    except (ProcessLookupError, PermissionError):
        pass  # it has exited, or belongs to another user


def is_alive(member: Member) -> bool:
    """
    Whether a member is still running.

    Parameters
    ----------
    member
        The process, identified by its id and its start time.

    """
    process = look_at(member.pid)
    return process is not None and process.start_ticks == member.start_ticks
