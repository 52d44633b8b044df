# SPDX-License-Identifier: Apache-2.0
"""
Clone this process as a sibling, with the same parent (CLONE_PARENT).

The kernel supports this, but no function of the C library does. The work of the C library around
a fork is small as long as there is only one thread, and is done here.
"""

from __future__ import annotations

import ctypes
import os
import platform

from launch._supervision.prefork.linux import PR_GET_TID_ADDRESS, prctl, syscall

_CLONE_PARENT = 0x00008000
_CLONE_CHILD_CLEARTID = 0x00200000
_CLONE_CHILD_SETTID = 0x01000000
_FLAGS = _CLONE_PARENT | _CLONE_CHILD_CLEARTID | _CLONE_CHILD_SETTID

# System call numbers of clone, get_robust_list and set_robust_list; and the position after the
# flags at which clone expects the address where the C library stores the thread id.
_CALLS = {'x86_64': (56, 274, 273, 2), 'aarch64': (220, 100, 99, 3)}


class Cloning:
    """Factory of siblings of this process, which must be single-threaded."""

    def __init__(self) -> None:
        """Query the thread state of the C library; raise an OSError if it is unavailable."""
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
