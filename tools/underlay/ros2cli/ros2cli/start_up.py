# SPDX-License-Identifier: Apache-2.0
"""
Make the interpreter of a command start and end fast.

Most commands take less time than the interpreter that runs them: what it does besides the
command's own work is what a user waits for. Whatever is here imports nothing.
"""

from __future__ import annotations

import os
import sys

TYPE_CHECKING = False

if TYPE_CHECKING:
    from typing import NoReturn  # noqa: I300

OBJECTS_BETWEEN_COLLECTIONS = 100_000


def prepare() -> None:
    """Let what follows be imported fast."""
    look_into_the_standard_library_first()
    collect_less_often()


def look_into_the_standard_library_first() -> None:
    """
    Put the standard library before the folders of PYTHONPATH.

    In a workspace each package has a folder of its own in PYTHONPATH, and an import asks the
    operating system about each folder until it has found its module: ten questions a module.
    Nor can a package that bears the name of a standard module break a command. The folder of the
    script is left out: it has programs, not modules.
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
    Look for cycles of garbage after many new objects, instead of after some hundred.

    While modules are imported nothing but new objects comes, and nothing of it is garbage.
    """
    import gc

    gc.set_threshold(OBJECTS_BETWEEN_COLLECTIONS, *gc.get_threshold()[1:])


def end(status: int) -> NoReturn:
    """
    End the process with a status, without taking the interpreter apart.

    Functions of atexit are called, and output is written. If threads are still at work, or the
    output cannot be written, the interpreter ends as usual.

    Parameters
    ----------
    status
        The exit status.

    Raises
    ------
    SystemExit
        The interpreter is to end as usual.

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
