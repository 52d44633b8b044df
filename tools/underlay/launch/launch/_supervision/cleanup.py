# SPDX-License-Identifier: Apache-2.0
"""
Program that terminates the orphaned processes of a killed launch, and removes its files.

A guard runs it by its path, `cleanup.py ID MARK START_TICKS`, and writes to its standard input one
line of process group ids, followed by one file path per line.
"""

from __future__ import annotations

import os
import select
import signal
import sys
import time

_STEPS = ((signal.SIGINT, 1.0), (signal.SIGTERM, 1.0), (signal.SIGKILL, 10.0))
_MOST_WATCHED = 256
_LOOK_EVERY_S = 0.05


def main(launch_id: str, mark: str, start_ticks: str) -> None:
    """
    Terminate the remaining processes of a launch with escalating signals; remove its files.

    Process groups and files are read from the standard input.

    Parameters
    ----------
    launch_id, mark, start_ticks
        As for `Family`; the numbers as decimal strings.

    """
    groups, *files = sys.stdin.read().splitlines()
    family = Family(launch_id, int(mark), int(start_ticks), map(int, groups.split()))
    try:
        for number, patience_s in _STEPS:
            if _end_with(family, number, patience_s):
                break
    finally:
        for file in files:
            _remove(file)


def _end_with(family: Family, number: signal.Signals, patience_s: float) -> bool:
    """Send a signal to all members, including new ones; return whether none is left."""
    end_s = time.monotonic() + patience_s
    told: set[Member] = set()
    while left := family.members():
        for member in left:
            if number == signal.SIGKILL or member not in told:
                send(member, number)
        told.update(left)
        if time.monotonic() >= end_s:
            return False
        _wait_for_end(left[:_MOST_WATCHED], end_s - time.monotonic())
    return True


def _wait_for_end(members: list[Member], patience_s: float) -> None:
    """Wait until one of the members has exited, and briefly for the others."""
    poll = select.poll()
    descriptors = []
    for member in members:
        try:
            descriptors.append(os.pidfd_open(member.pid))
        except (AttributeError, OSError):
            patience_s = min(patience_s, _LOOK_EVERY_S)
        else:
            poll.register(descriptors[-1], select.POLLIN)
    if poll.poll(max(patience_s, 0.0) * 1000):
        time.sleep(max(min(patience_s, _LOOK_EVERY_S), 0.0))
    for descriptor in descriptors:
        os.close(descriptor)


def _remove(file: str) -> None:
    try:
        os.unlink(file)
    except OSError:
        pass  # it was never created, or is already removed


if __name__ == '__main__':
    folder = os.path.dirname(os.path.abspath(__file__))
    sys.path.insert(0, os.path.dirname(os.path.dirname(folder)))
    import launch._supervision

    del sys.path[:2]
    from launch._supervision.family import Family
    from launch._supervision.member import Member, send

    assert launch
    main(*sys.argv[1:])
