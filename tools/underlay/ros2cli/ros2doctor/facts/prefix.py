# SPDX-License-Identifier: Apache-2.0
"""The virtual environment that has the wheels."""

from __future__ import annotations

from functools import lru_cache
import os
from pathlib import Path
import platform
import re
import sys

from ros_environment.installed import prefixes

MARKER = 'pyvenv.cfg'
VERSION = re.compile(r'^version(?:_info)? *= *(\d+\.\d+\.\d+)', re.MULTILINE)


@lru_cache(maxsize=1)
def environment_prefix() -> str:
    """Return the environment that was sourced; without one that of the running Python."""
    sourced = (str(prefix) for prefix in prefixes() if (prefix / MARKER).is_file())
    return next(sourced, sys.prefix)


def python_version() -> str:
    """Return the version of the environment's Python, which need not be the running one."""
    marker = Path(environment_prefix(), MARKER)
    text = marker.read_text(encoding='utf-8') if marker.is_file() else ''
    found = VERSION.search(text)
    return found[1] if found else platform.python_version()


def is_own(program: str) -> bool:
    """
    Check whether a program is in the `bin` folder of the environment.

    Folders are compared, because the Python of an environment is a link to that of the system.

    Parameters
    ----------
    program
        The path of the program, which itself may be a link.

    Returns
    -------
    bool
        Whether it is.

    """
    own = os.path.join(environment_prefix(), 'bin')
    return os.path.realpath(os.path.dirname(program)) == os.path.realpath(own)
