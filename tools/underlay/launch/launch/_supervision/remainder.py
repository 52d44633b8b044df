# SPDX-License-Identifier: Apache-2.0
"""Terminate processes outside the supervised groups, when their ancestor or the launch ends."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Collection, Iterable
import os
import signal
import time
from typing import Any, Optional

from launch._supervision.family import Family
from launch._supervision.member import is_alive, Member, send
from launch.logging import get_logger

_AFTER_SIGKILL_S = 5.0
_AT_ONCE_S = 2.0
_LOOK_EVERY_S = 0.02  # if no pidfd can be opened
_MOST_WATCHED = 64  # at a time, as each of them takes a descriptor
_MOST_NAMED = 5


Find = Callable[[signal.Signals], list[Member]]


class Remainder:
    """
    Escalation of signals to the members of a launch that have no supervisor.

    Parameters
    ----------
    family
        The processes of the launch.
    supervised_groups
        Returns the ids of the process groups that have a supervisor now.

    """

    def __init__(self, family: Family, supervised_groups: Callable[[], Collection[int]]) -> None:
        self._family = family
        self._supervised_groups = supervised_groups
        self._is_alone = asyncio.Event()
        self._task: Optional[asyncio.Task[None]] = None

    def begin(self, sigterm_s: float, sigkill_s: float) -> None:
        """
        Send SIGINT to processes outside the supervised groups, and schedule the other signals.

        Does nothing if this is already in progress.

        Parameters
        ----------
        sigterm_s, sigkill_s
            The time from SIGINT to SIGTERM and from SIGTERM to SIGKILL, in s.

        """
        if self._task is None or self._task.done():
            ending = end_members(self._left, sigterm_s, sigkill_s, changed=self._is_alone)
            self._task = asyncio.ensure_future(ending)

    async def finish(self, sigterm_s: float, sigkill_s: float) -> None:
        """
        Terminate all remaining processes, after all supervisors have finished.

        Parameters
        ----------
        sigterm_s, sigkill_s
            As for `begin`.

        """
        self._is_alone.set()
        if self._task is not None:
            await self._task
        await end_members(self._left, sigterm_s, sigkill_s)

    def _left(self, number: signal.Signals) -> list[Member]:
        """Return the members to signal; a nested launch terminates its own processes."""
        members = self._family.members()
        if self._is_alone.is_set():
            return members
        groups = self._supervised_groups()
        with_nested = number == signal.SIGKILL
        return [m for m in members if m.group not in groups and (with_nested or not m.is_nested)]


class EscapedProcesses:
    """The descendants of a process that have left its group; they get its signals as well."""

    def __init__(self) -> None:
        self._members: list[Member] = []

    def note(self, group: int, descendants: Iterable[Member], number: signal.Signals) -> None:
        """
        Record the descendants outside the group while their ancestry is known.

        Parameters
        ----------
        group
            The id of the group, which is that of the process.
        descendants
            What the process has started, directly or indirectly.
        number
            The signal that is sent next; those of a nested launch get only SIGKILL.

        """
        with_nested = number == signal.SIGKILL
        news = (
            member
            for member in descendants
            if member.group != group and (with_nested or not member.is_nested)
        )
        self._members = list(dict.fromkeys([*filter(is_alive, self._members), *news]))

    def send(self, number: signal.Signals) -> None:
        """
        Send a signal to all of them.

        Parameters
        ----------
        number
            The signal.

        """
        for member in self._members:
            send(member, number)

    async def end(self, sigterm_s: float, sigkill_s: float) -> None:
        """
        Terminate those that have survived the signals sent to the process.

        Parameters
        ----------
        sigterm_s, sigkill_s
            The time from SIGINT to SIGTERM and from SIGTERM to SIGKILL, in s.

        """
        if not self._members:
            return
        await end_members(
            lambda number: [member for member in self._members if is_alive(member)],
            sigterm_s,
            sigkill_s,
            interrupted=self._members,
        )
        self._members = []


async def end_members(
    find: Find,
    sigterm_s: float,
    sigkill_s: float,
    *,
    interrupted: Collection[Member] = (),
    changed: Optional[asyncio.Event] = None,
) -> None:
    """
    Send SIGINT, SIGTERM and SIGKILL, one after the other, until no member is left.

    Parameters
    ----------
    find
        Called with the signal; returns the remaining members to send it to.
    sigterm_s
        The time from SIGINT to SIGTERM in s.
    sigkill_s
        The time from SIGTERM to SIGKILL in s.
    interrupted
        The members that have already received SIGINT.
    changed
        An event that is set when `find` may return other members.

    """
    steps = (
        (signal.SIGINT, sigterm_s),
        (signal.SIGTERM, sigkill_s),
        (signal.SIGKILL, _AFTER_SIGKILL_S),
    )
    told = set(interrupted)
    for number, patience_s in steps:
        if await _end_with(number, patience_s, find, told, changed):
            return
        told = set()
    if left := find(signal.SIGKILL):
        get_logger('launch').error('could not end %s', _names(left))


async def _end_with(
    number: signal.Signals,
    patience_s: float,
    find: Find,
    told: set[Member],
    changed: Optional[asyncio.Event],
) -> bool:
    """Send a signal to all members, including new ones; return whether none is left."""
    loop = asyncio.get_running_loop()
    end_s = loop.time() + patience_s
    while left := find(number):
        if not told:
            text = "sending signal '%s' to what has left the group of its process: %s"
            get_logger('launch').info(text, number.name, _names(left))
        for member in left:
            if number == signal.SIGKILL or member not in told:
                send(member, number)
        told.update(left)
        if loop.time() >= end_s:
            return False
        await _wait(left[:_MOST_WATCHED], end_s - loop.time(), changed)
    return True


async def _wait(
    members: list[Member], patience_s: float, changed: Optional[asyncio.Event]
) -> None:
    """Wait until the members have exited, or until there may be others."""
    tasks: list[asyncio.Future[Any]] = [asyncio.gather(*map(_ended, members))]
    if changed is not None and not changed.is_set():
        tasks.append(asyncio.ensure_future(changed.wait()))
    try:
        await asyncio.wait(tasks, timeout=patience_s, return_when=asyncio.FIRST_COMPLETED)
    finally:
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)


def kill_at_once(family: Family) -> None:
    """
    Kill all members at once, without a graceful termination.

    Parameters
    ----------
    family
        The processes of the launch.

    """
    end_s = time.monotonic() + _AT_ONCE_S
    while (members := family.members()) and time.monotonic() < end_s:
        for member in members:
            send(member, signal.SIGKILL)


async def _ended(member: Member) -> None:
    """Wait for a member to exit."""
    loop = asyncio.get_running_loop()
    try:
        descriptor = os.pidfd_open(member.pid)
    except ProcessLookupError:
        return
    except (AttributeError, OSError):
        while is_alive(member):
            await asyncio.sleep(_LOOK_EVERY_S)
        return
    ended = asyncio.Event()
    loop.add_reader(descriptor, ended.set)
    try:
        if is_alive(member):
            await ended.wait()
    finally:
        loop.remove_reader(descriptor)
        os.close(descriptor)


def _names(members: list[Member]) -> str:
    named = ', '.join(str(member) for member in members[:_MOST_NAMED])
    more = len(members) - _MOST_NAMED
    return f'{named} and {more} more' if more > 0 else named
