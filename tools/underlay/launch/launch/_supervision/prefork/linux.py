# SPDX-License-Identifier: Apache-2.0
"""Calls of Linux that the `os` module does not offer."""

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

# The interpreter stays locked during a call, so that no thread can come in between.
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
        Its other arguments: numbers, or pointers of ctypes.

    Raises
    ------
    OSError
        The system refuses.

    """
    arguments = [_argument(value) for value in (second, third, fourth, 0)]
    _check(_libc.prctl(operation, *arguments))


def syscall(number: int, *arguments: int) -> int:
    """
    Call the kernel with plain numbers.

    Parameters
    ----------
    number
        The number of the call on this architecture.
    *arguments
        The arguments, each of which is passed as an unsigned long.

    Returns
    -------
    int
        What the call returns.

    Raises
    ------
    OSError
        The call has failed.

    """
    return _check(_libc.syscall(ctypes.c_long(number), *(ctypes.c_ulong(a) for a in arguments)))


def is_subreaper() -> bool:
    """Return whether orphans of the processes below this one become its children."""
    value = ctypes.c_int()
    prctl(PR_GET_CHILD_SUBREAPER, ctypes.byref(value))
    return bool(value.value)


@contextmanager
def adopting_orphans() -> Iterator[None]:
    """Become the parent of orphans for a moment."""
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
