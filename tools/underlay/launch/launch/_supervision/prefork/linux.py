# SPDX-License-Identifier: Apache-2.0
"""Linux system calls that the `os` module does not provide."""

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
