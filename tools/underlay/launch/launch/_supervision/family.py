# SPDX-License-Identifier: Apache-2.0
"""
Identify the processes that a launch has started, directly or indirectly.

Even if a process leaves its group and session or loses its parent, its descendants inherit its
resource limits and its environment. A launch marks its processes with the soft limit RLIMIT_LOCKS,
which Linux has not enforced since 2.4.25 but still passes on: it is read with one call, survives
a cleared environment, and users see no variable that they have not set. If the limit cannot be
set, or has no room for another nested launch, the variable `ROS_LAUNCH_ID` is the mark.

This module needs the standard library only, as the clean-up after a killed launch also uses it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from itertools import count
import os
import resource
from typing import Optional, TYPE_CHECKING

if TYPE_CHECKING:
    from launch._supervision.member import Member

ID_VARIABLE = 'ROS_LAUNCH_ID'
"""The launches that a process belongs to, from the outermost to the innermost."""

DETACHED_VARIABLE = 'ROS_LAUNCH_DETACHED'
"""A process in whose environment this is set and not empty may outlive its launch."""

_RLIMIT_LOCKS = 10  # the `resource` module has no name for it
_RUN_BITS = 8
_LAUNCH_BITS = 22 + _RUN_BITS  # process ids have 22 bits at most
_INIT = 1  # the parent of orphans; in a container that may be the launch
_MOST_LOOKS = 50
_runs = count()


class Family:
    """
    Processes of one run of a launch, in this process or another one.

    Parameters
    ----------
    launch_id
        Identifies the run in the variable `ROS_LAUNCH_ID`.
    mark
        The soft limit RLIMIT_LOCKS that its processes have; 0 if they only have the variable.
    start_ticks
        The start time of the process of the run, in clock ticks since boot; no member is older.
    sessions
        All processes in these sessions also belong to the family.

    """

    def __init__(
        self, launch_id: str, mark: int, start_ticks: int, sessions: Iterable[int] = ()
    ) -> None:
        self.id = launch_id
        self.mark = mark
        self.start_ticks = start_ticks
        self._sessions = frozenset(sessions)
        self._detached = os.environ.get(DETACHED_VARIABLE)
        self._outer = None if self._detached else os.environ.get(ID_VARIABLE)

    @classmethod
    def of_new_run(cls) -> Family:
        """Create the family of a new run in this process."""
        pid, run = os.getpid(), next(_runs)
        start_ticks = _start_ticks(pid)
        return cls(f'{pid}.{start_ticks}.{run}', _new_mark(pid, run), start_ticks)

    # Marking.

    def environment(self, environment: Mapping[str, str]) -> dict[str, str]:
        """
        Mark the environment of a process of this launch.

        A launch that may outlive the enclosing one does not pass this permission on.

        Parameters
        ----------
        environment
            The variables of the process.

        Returns
        -------
        dict
            A copy, with the variable `ROS_LAUNCH_ID` if the mark is not a resource limit.

        """
        marked = dict(environment)
        if not self.mark:
            marked[ID_VARIABLE] = f'{self._outer}/{self.id}' if self._outer else self.id
        if not self.detaches(marked):
            marked.pop(DETACHED_VARIABLE, None)
        return marked

    @contextmanager
    def marking(self) -> Iterator[None]:
        """Mark the processes that are started within a context."""
        with _limit(self.mark) if self.mark else _unchanged():
            yield

    def detaches(self, environment: Mapping[str, str]) -> bool:
        """
        Whether a process with this environment may outlive the launch.

        Parameters
        ----------
        environment
            Its variables; `ROS_LAUNCH_DETACHED` counts if this launch has not inherited its value.

        """
        value = environment.get(DETACHED_VARIABLE)
        return bool(value) and value != self._detached

    # Finding.

    def members(self) -> list[Member]:
        """
        Return the running processes of the launch that must not outlive it.

        Processes that keep forking and exiting may be gone when they are examined. If a candidate
        is gone, others may have appeared, so the search is repeated: there is no member only if
        all candidates still exist.
        """
        for _ in range(_MOST_LOOKS):
            candidates = self._candidates()
            found = [member for member in map(self._member, candidates) if member is not None]
            if found or all(map(_exists, candidates)):
                return found
        return []

    def descendants(self, pid: int) -> list[Member]:
        """
        List the members that descend from a process.

        Parameters
        ----------
        pid
            The id of the process.

        Returns
        -------
        list of Member
            The members that have the process among their ancestors.

        """
        members = self.members()
        ancestors = {pid}
        while True:
            more = {m.pid for m in members if m.parent in ancestors} - ancestors
            if not more:
                return [m for m in members if m.pid in ancestors and m.pid != pid]
            ancestors |= more

    def _candidates(self) -> list[int]:
        """Return the ids of processes that may be members, by an inexpensive pre-selection."""
        pids = [int(name) for name in os.listdir('/proc') if name.isdigit()]
        if not self.mark or self._sessions:
            return pids
        return [pid for pid in pids if self.mark in _marks_of(pid)]

    def _member(self, pid: int) -> Optional[Member]:
        from launch._supervision.member import look_at, variables_of

        process = look_at(pid)
        if process is None or process.start_ticks < self.start_ticks or pid == os.getpid():
            return None
        variables = variables_of(pid)
        if variables.get(DETACHED_VARIABLE):
            return None
        ids = list(filter(None, variables.get(ID_VARIABLE, '').split('/')))
        if self.id in ids:
            return process.of_launch(nested=ids[-1] != self.id)
        if process.session in self._sessions:
            return process
        return self._member_by_mark(process, has_inner_id=bool(ids))

    def _member_by_mark(self, process: Member, *, has_inner_id: bool) -> Optional[Member]:
        """
        Return a process whose variable does not name this launch, if it has the mark.

        Processes that other threads start while `marking` is in force have the mark, too. They are
        recognised by their parent, this process; those of the launch have another one or are
        known.
        """
        marks = _marks_of(process.pid)
        if not self.mark or self.mark not in marks or process.parent == os.getpid() != _INIT:
            return None
        return process.of_launch(nested=has_inner_id or self.mark != marks[0])


@contextmanager
def unmarked() -> Iterator[None]:
    """Start the processes within a context without the mark of any launch."""
    with _limit(resource.RLIM_INFINITY):
        yield


def detached_environment(environment: Mapping[str, str]) -> dict[str, str]:
    """
    Mark the environment of a process that may outlive all launches.

    Parameters
    ----------
    environment
        The variables of the process.

    Returns
    -------
    dict
        A copy, with the variable `ROS_LAUNCH_DETACHED` instead of `ROS_LAUNCH_ID`.

    """
    return {
        **{name: value for name, value in environment.items() if name != ID_VARIABLE},
        DETACHED_VARIABLE: '1',
    }


def _new_mark(pid: int, run: int) -> int:
    """Return the mark of a new run, prefixed with that of the enclosing launch."""
    outer, most = resource.getrlimit(_RLIMIT_LOCKS)
    if most != resource.RLIM_INFINITY or outer >> _LAUNCH_BITS > 0:
        return 0  # setting it is not permitted, or there is no room for a third mark
    own = pid << _RUN_BITS | run % (1 << _RUN_BITS)
    return max(outer, 0) << _LAUNCH_BITS | own


@contextmanager
def _limit(value: int) -> Iterator[None]:
    before, most = resource.getrlimit(_RLIMIT_LOCKS)
    if most != resource.RLIM_INFINITY:
        value = before
    resource.setrlimit(_RLIMIT_LOCKS, (value, most))
    try:
        yield
    finally:
        resource.setrlimit(_RLIMIT_LOCKS, (before, most))


@contextmanager
def _unchanged() -> Iterator[None]:
    yield


def _marks_of(pid: int) -> tuple[int, ...]:
    """Return the marks of the launch that a process belongs to, and of the enclosing launch."""
    try:
        mark = resource.prlimit(pid, _RLIMIT_LOCKS)[0]
    except OSError:  # it has exited, or belongs to another user
        return ()
    return (mark, mark >> _LAUNCH_BITS) if mark > 0 else ()


def _exists(pid: int) -> bool:
    return os.path.exists(f'/proc/{pid}')


def _start_ticks(pid: int) -> int:
    """Return the start time of a process, in clock ticks since boot."""
    with open(f'/proc/{pid}/stat', 'rb') as file:
        return int(file.read().rpartition(b')')[2].split()[19])
