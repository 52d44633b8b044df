# SPDX-License-Identifier: Apache-2.0
"""
Linux system calls that the `os` module does not provide.

Among them is cloning this process as a sibling, with the same parent (CLONE_PARENT). The kernel
supports this, but no function of the C library does. The work of the C library around a fork is
small as long as there is only one thread, and is done here.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
import ctypes
import os

PR_SET_NAME = 15
PR_SET_MM = 35
PR_SET_MM_MAP = 14
PR_SET_CHILD_SUBREAPER = 36
PR_GET_CHILD_SUBREAPER = 37
PR_GET_TID_ADDRESS = 40

# PyDLL holds the GIL during a call, so that no other thread can run in between.
_libc = ctypes.PyDLL(None, use_errno=True)
_libc.syscall.restype = ctypes.c_long

_CLONE_PARENT = 0x00008000
_CLONE_CHILD_CLEARTID = 0x00200000
_CLONE_CHILD_SETTID = 0x01000000
_FLAGS = _CLONE_PARENT | _CLONE_CHILD_CLEARTID | _CLONE_CHILD_SETTID

# System call numbers of clone, get_robust_list and set_robust_list; and the position after the
# flags at which clone expects the address where the C library stores the thread id.
_CALLS = {'x86_64': (56, 274, 273, 2), 'aarch64': (220, 100, 99, 3)}


def prctl(operation: int, second: object = 0, third: object = 0, fourth: object = 0) -> None:
    """
    Read or change a property of this process, as the system call of this name does.

    Parameters
    ----------
    operation
        The number of the operation, such as `PR_SET_NAME`.
    second, third, fourth
        Its other arguments: numbers, or ctypes pointers.

    Raises
    ------
    OSError
        The system call has failed.

    """
    arguments = [_argument(value) for value in (second, third, fourth, 0)]
    _check(_libc.prctl(operation, *arguments))


def syscall(number: int, *arguments: int) -> int:
    """
    Make a system call with integer arguments.

    Parameters
    ----------
    number
        The system call number on this architecture.
    *arguments
        The arguments, each of which is passed as an unsigned long.

    Returns
    -------
    int
        The return value of the call.

    Raises
    ------
    OSError
        The call has failed.

    """
    return _check(_libc.syscall(ctypes.c_long(number), *(ctypes.c_ulong(a) for a in arguments)))


def is_subreaper() -> bool:
    """Check whether this process is a subreaper, which adopts orphaned descendants."""
    value = ctypes.c_int()
    prctl(PR_GET_CHILD_SUBREAPER, ctypes.byref(value))
    return bool(value.value)


@contextmanager
def adopting_orphans() -> Iterator[None]:
    """Act as a subreaper, which adopts orphaned descendants, within a context."""
    before = is_subreaper()
    prctl(PR_SET_CHILD_SUBREAPER, 1)
    try:
        yield
    finally:
        prctl(PR_SET_CHILD_SUBREAPER, int(before))


def _argument(value: object) -> object:
    return ctypes.c_ulong(value) if isinstance(value, int) else value


def _check(result: int) -> int:
    if result == -1:
        number = ctypes.get_errno()
        raise OSError(number, os.strerror(number))
    return result


class Cloning:
    """Factory of siblings of this process, which must be single-threaded."""

    def __init__(self) -> None:
        """Query the thread state of the C library; raise an OSError if it is unavailable."""
        import platform

        if platform.machine() not in _CALLS:
            raise OSError(f'processes cannot be cloned on {platform.machine()}')
        self._clone, self._get_list, self._set_list, position = _CALLS[platform.machine()]
        tid_address = ctypes.c_ulong()
        prctl(PR_GET_TID_ADDRESS, ctypes.byref(tid_address))
        self._arguments = [_FLAGS, 0, 0, 0, 0]
        self._arguments[1 + position] = tid_address.value
        self._robust_list = self._find_robust_list()

    def _find_robust_list(self) -> tuple[int, int]:
        """Return address and size of the robust futex list of the C library for this thread."""
        address, size = ctypes.c_ulong(), ctypes.c_size_t()
        syscall(self._get_list, 0, ctypes.addressof(address), ctypes.addressof(size))
        return address.value, size.value

    def make_sibling(self) -> int:
        """Clone this process; return the process id of the clone, or 0 in the clone."""
        threads = len(os.listdir('/proc/self/task'))
        if threads != 1:
            raise OSError(f'a process with {threads} threads cannot be cloned')
        ctypes.pythonapi.PyOS_BeforeFork()
        try:
            pid = syscall(self._clone, *self._arguments)
        except OSError:
            ctypes.pythonapi.PyOS_AfterFork_Parent()
            raise
        if pid != 0:
            ctypes.pythonapi.PyOS_AfterFork_Parent()
            return pid
        ctypes.pythonapi.PyOS_AfterFork_Child()
        syscall(self._set_list, *self._robust_list)
        return 0
