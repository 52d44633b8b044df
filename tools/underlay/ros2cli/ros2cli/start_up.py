# SPDX-License-Identifier: Apache-2.0
"""
Fast startup and exit of the interpreter, with usable standard streams.

Most commands take less time than the interpreter that runs them, so that its overhead dominates
what a user waits for. This module imports nothing itself.
"""

from __future__ import annotations

import os
import sys

TYPE_CHECKING = False

if TYPE_CHECKING:
    from typing import NoReturn  # noqa: I300

OBJECTS_BETWEEN_COLLECTIONS = 100_000
STREAM_NAMES = ('stdin', 'stdout', 'stderr')


def prepare() -> None:
    """Speed up the imports that follow."""
    look_into_the_standard_library_first()
    collect_less_often()


def look_into_the_standard_library_first() -> None:
    """
    Put the standard library before the folders of PYTHONPATH.

    In a workspace each package has its own folder in PYTHONPATH, and an import searches one folder
    after the other, with about ten system calls per module. The order also prevents a package
    with the name of a standard module from breaking a command. The folder of the script is left
    out: it contains programs, not modules.
    """
    library = os.path.dirname(os.__file__)
    archive = os.path.join(os.path.dirname(library), 'python')
    standard = [
        path
        for path in sys.path
        if path in (library, os.path.join(library, 'lib-dynload'))
        or (path.startswith(archive) and path.endswith('.zip'))
    ]
    script = os.path.dirname(os.path.realpath(sys.argv[0]))
    others = [path for path in sys.path if path not in standard and path != script]
    sys.path[:] = [*standard, *others]


def collect_less_often() -> None:
    """
    Raise the threshold of the garbage collector from some hundred new objects to many.

    Imports only create new objects, none of which are garbage.
    """
    import gc

    gc.set_threshold(OBJECTS_BETWEEN_COLLECTIONS, *gc.get_threshold()[1:])


def open_standard_streams() -> None:
    """
    Open standard streams that the caller has closed, as in `ros2 topic list >&-`, on /dev/null.

    Otherwise the next file or socket would get the descriptor, and receive the output.
    """
    for descriptor, name in enumerate(STREAM_NAMES):
        if getattr(sys, name) is None and not _is_open(descriptor):
            os.open(os.devnull, os.O_RDWR)  # the lowest free descriptor: this one
            setattr(sys, name, os.fdopen(descriptor, 'r' if descriptor == 0 else 'w'))


def _is_open(descriptor: int) -> bool:
    try:
        os.fstat(descriptor)
    except OSError:
        return False
    return True


def end(status: int) -> NoReturn:
    """
    Exit the process with a status, without finalizing the interpreter.

    Functions of atexit are called, and output is flushed. If threads are still running, or the
    output cannot be written, the interpreter exits as usual.

    Parameters
    ----------
    status
        The exit status.

    Raises
    ------
    SystemExit
        The interpreter must exit as usual.

    """
    import atexit

    threading = sys.modules.get('threading')
    if threading is None or threading.active_count() == 1:
        atexit._run_exitfuncs()
        try:
            for stream in (sys.stdout, sys.stderr):
                if stream is not None and not stream.closed:
                    stream.flush()
        except OSError:
            sys.exit(status)
        os._exit(status)
    sys.exit(status)
