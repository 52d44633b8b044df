# SPDX-License-Identifier: Apache-2.0
"""Process groups: a process and the processes that it has started."""

from __future__ import annotations

import os
import signal

_TO_THE_GROUP = frozenset(
    (signal.SIGINT, signal.SIGTERM, signal.SIGQUIT, signal.SIGKILL, signal.SIGSTOP, signal.SIGCONT)
)


def send_signal(pid: int, number: signal.Signals) -> None:
    """
    Send a signal to a process that leads its group.

    Signals that terminate, stop or continue go to the whole group, because the process may be a
    wrapper around the actual program; other signals go to the process alone.

    Parameters
    ----------
    pid
        The id of the process, which is also that of the group; nothing is done if it has ended.
    number
        The signal.

    """
    try:
        if number in _TO_THE_GROUP:
            os.killpg(pid, number)
        else:
            os.kill(pid, number)
    except (ProcessLookupError, PermissionError):
        pass  # it has exited, or belongs to another user


def is_empty(group: int) -> bool:
    """
    Whether no process of a group is left, apart from zombies.

    Parameters
    ----------
    group
        The id of the group.

    """
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return True
    except PermissionError:
        return False
    return not living_members(group)


def living_members(group: int) -> list[int]:
    """
    List the ids of the processes of a group, except for zombies.

    Parameters
    ----------
    group
        The id of the group.

    """
    pids = [int(name) for name in os.listdir('/proc') if name.isdigit()]
    return [pid for pid in pids if _is_living_member(pid, group)]


def _is_living_member(pid: int, group: int) -> bool:
    try:
        with open(f'/proc/{pid}/stat', 'rb') as file:
            fields = file.read().rpartition(b')')[2].split()
    except OSError:
        return False
    return int(fields[2]) == group and fields[0] not in (b'Z', b'X')
