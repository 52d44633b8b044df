# SPDX-License-Identifier: Apache-2.0
"""
Make a copy of this process whose parent is the parent of this process.

The system can do that, but no function of the C library asks for it. What the C library would
do around a fork is little as long as there is only one thread, and is done here.
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

# Numbers of the calls clone, get_robust_list and set_robust_list; and where, behind the flags,
# clone expects the address at which the C library keeps the id of the thread.
_CALLS = {'x86_64': (56, 274, 273, 2), 'aarch64': (220, 100, 99, 3)}


class Cloning:
    """Makes siblings of this process, which must have one thread only."""

    def __init__(self) -> None:
        """Find out what is needed; an OSError says that the system does not tell."""
        if platform.machine() not in _CALLS:
            raise OSError(f'processes cannot be cloned on {platform.machine()}')
        self._clone, self._get_list, self._set_list, position = _CALLS[platform.machine()]
        tid_address = ctypes.c_ulong()
        prctl(PR_GET_TID_ADDRESS, ctypes.byref(tid_address))
        self._arguments = [_FLAGS, 0, 0, 0, 0]
        self._arguments[1 + position] = tid_address.value
        self._robust_list = self._find_robust_list()

    def _find_robust_list(self) -> tuple[int, int]:
        """Return address and size of the list of locks that the C library keeps for a thread."""
        address, size = ctypes.c_ulong(), ctypes.c_size_t()
        syscall(self._get_list, 0, ctypes.addressof(address), ctypes.addressof(size))
        return address.value, size.value

    def make_sibling(self) -> int:
        """Copy this process; return the id of the copy, and 0 in the copy."""
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
