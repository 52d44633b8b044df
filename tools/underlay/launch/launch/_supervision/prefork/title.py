# SPDX-License-Identifier: Apache-2.0
"""Set the command line and the environment that `ps` and /proc show."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
import ctypes
import os

from launch._supervision.prefork.linux import PR_SET_MM, PR_SET_MM_MAP, PR_SET_NAME, prctl

# The fields of /proc/self/stat that the system call requires, counted after the name.
_STAT = {
    'start_code': 23,
    'end_code': 24,
    'start_data': 42,
    'end_data': 43,
    'start_brk': 44,
    'start_stack': 25,
}


class _MemoryMap(ctypes.Structure):
    """Memory layout of a process (struct prctl_mm_map)."""

    _fields_ = [
        *((name, ctypes.c_uint64) for name in ('start_code', 'end_code', 'start_data')),
        *((name, ctypes.c_uint64) for name in ('end_data', 'start_brk', 'brk', 'start_stack')),
        *((name, ctypes.c_uint64) for name in ('arg_start', 'arg_end', 'env_start', 'env_end')),
        ('auxv', ctypes.c_void_p),
        ('auxv_size', ctypes.c_uint32),
        ('exe_fd', ctypes.c_uint32),
    ]


def set_title(name: str, arguments: Sequence[str], environment: Mapping[str, str]) -> None:
    """
    Set the name, the command line and the environment that `ps` and /proc show.

    Parameters
    ----------
    name
        The name of the process, which is truncated to 15 bytes.
    arguments : Sequence[str]
        The words of the command line.
    environment
        The variables.

    Raises
    ------
    OSError
        The system call has failed.

    """
    prctl(PR_SET_NAME, ctypes.c_char_p(os.fsencode(name)[:15]))
    words = _block(arguments)
    variables = _block(f'{key}={value}' for key, value in environment.items())
    start = _keep(words + variables)
    places = _MemoryMap(
        arg_start=start,
        arg_end=start + len(words),
        env_start=start + len(words),
        env_end=start + len(words) + len(variables),
        brk=_end_of_heap(),
        exe_fd=0xFFFFFFFF,
        **_present_places(),
    )
    prctl(PR_SET_MM, PR_SET_MM_MAP, ctypes.byref(places), ctypes.sizeof(places))


def _block(texts: Iterable[str]) -> bytes:
    return b''.join(os.fsencode(text) + b'\0' for text in texts)


def _keep(data: bytes) -> int:
    """Copy data to memory that lives as long as the process; return its address."""
    buffer = ctypes.create_string_buffer(data, len(data))
    ctypes.pythonapi.Py_IncRef(ctypes.py_object(buffer))
    return ctypes.addressof(buffer)


def _end_of_heap() -> int:
    sbrk = ctypes.PyDLL(None).sbrk
    sbrk.restype = ctypes.c_uint64
    return int(sbrk(ctypes.c_long(0)))


def _present_places() -> dict[str, int]:
    with open('/proc/self/stat', 'rb') as file:
        fields = file.read().rpartition(b')')[2].split()
    return {name: int(fields[index]) for name, index in _STAT.items()}
