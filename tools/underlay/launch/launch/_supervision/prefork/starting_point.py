# SPDX-License-Identifier: Apache-2.0
"""
Set up a clone of the template as a program that has just started.

It gets the standard streams as Python makes them at startup, and the command line and the
environment that `ps` and /proc show.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
import ctypes
from importlib.machinery import SourceFileLoader
import io
import os
import sys
import threading
import types
from typing import Any, TextIO

from launch._supervision.prefork.linux import PR_SET_MM, PR_SET_MM_MAP, PR_SET_NAME, prctl

_NAMES = ('stdin', 'stdout', 'stderr')

# The fields of /proc/self/stat that the system call requires, counted after the name.
_STAT = {
    'start_code': 23,
    'end_code': 24,
    'start_data': 42,
    'end_data': 43,
    'start_brk': 44,
    'start_stack': 25,
}


def enter(program: Mapping[str, Any], descriptors: tuple[int, int, int]) -> None:
    """
    Set up this process as a program that has just started.

    It leads a session of its own, and gets the streams, the working directory, the environment,
    the arguments and the title of the program.

    Parameters
    ----------
    program
        `interpreter`, `command`, `cwd` and `env`, as `ForkRequest` sends them.
    descriptors
        The standard input, output and error; they are closed.

    """
    os.setsid()
    os.chdir(program['cwd'])
    os.environ.clear()
    os.environ.update(program['env'])
    take_over(descriptors)
    _number_main_thread()
    command = [program['interpreter'], *program['command']]
    sys.argv = list(program['command'])
    sys.orig_argv = command
    script = program['command'][0]
    if not getattr(sys.flags, 'safe_path', False):
        sys.path.insert(0, os.path.dirname(os.path.realpath(script)))
    set_title(os.path.basename(script), command, program['env'])


def main_module(script: str) -> tuple[types.CodeType, dict[str, Any]]:
    """
    Create the module `__main__` for a script.

    Parameters
    ----------
    script
        The path of the script.

    Returns
    -------
    tuple
        The compiled code, and the namespace of the module in which to execute it.

    """
    module = types.ModuleType('__main__')
    names = vars(module)
    names.update(
        __annotations__={},
        __builtins__=sys.modules['builtins'],
        __cached__=None,
        __file__=script,
        __loader__=SourceFileLoader('__main__', script),
    )
    sys.modules['__main__'] = module
    with open(script, 'rb') as file:
        code = compile(file.read(), script, 'exec', dont_inherit=True)
    return code, names


def forget_packages(names: Iterable[str]) -> None:
    """
    Remove packages that only the template needs from `sys.modules`.

    Parameters
    ----------
    names
        The names of top-level packages, whose modules are removed as well.

    """
    unwanted = set(names)
    for name in [name for name in sys.modules if name.partition('.')[0] in unwanted]:
        del sys.modules[name]


def _number_main_thread() -> None:
    """Update the native id of the main thread, which is outdated after a fork."""
    threading.main_thread()._set_native_id()  # type: ignore[attr-defined]


def take_over(descriptors: tuple[int, int, int]) -> None:
    """
    Make three descriptors the standard input, output and error of this process.

    Parameters
    ----------
    descriptors
        The descriptors, in this order; they are closed.

    """
    for number, descriptor in enumerate(descriptors):
        os.dup2(descriptor, number)
        os.close(descriptor)
        _renew(number, _NAMES[number])


def _renew(number: int, name: str) -> None:
    """Replace a standard stream by one for its new file descriptor."""
    stream = _open(number, name, getattr(sys, name))
    setattr(sys, name, stream)
    setattr(sys, f'__{name}__', stream)


def _open(number: int, name: str, former: TextIO) -> TextIO:
    unbuffered = os.environ.get('PYTHONUNBUFFERED', '') != '' and not sys.flags.ignore_environment
    mode = 'w' if number else 'r'
    buffering = 0 if unbuffered and number else -1
    binary: Any = os.fdopen(number, f'{mode}b', buffering=buffering, closefd=False)
    raw = getattr(binary, 'raw', binary)
    raw.name = f'<{name}>'
    stream: Any = io.TextIOWrapper(
        binary,
        encoding=former.encoding,
        errors=former.errors,
        newline='\n',
        line_buffering=not unbuffered and (number == 2 or raw.isatty()),
        write_through=unbuffered,
    )
    stream.mode = mode
    renewed: TextIO = stream
    return renewed


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
