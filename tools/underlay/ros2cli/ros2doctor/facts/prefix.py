# SPDX-License-Identifier: Apache-2.0
"""The virtual environment that has the wheels."""

from __future__ import annotations

from functools import lru_cache
import os
import sys

from ros_environment.installed import prefixes

MARKER = 'pyvenv.cfg'


@lru_cache(maxsize=1)
def environment_prefix() -> str:
    """Return the environment that was sourced; without one that of the running Python."""
    sourced = (str(prefix) for prefix in prefixes() if (prefix / MARKER).is_file())
    return next(sourced, sys.prefix)


def is_own(program: str) -> bool:
    """
    Tell whether a program is in the folder of the environment's programs.

    Folders are compared, because the Python of an environment is a link to that of the system.
    """
    own = os.path.join(environment_prefix(), 'bin')
    return os.path.realpath(os.path.dirname(program)) == os.path.realpath(own)
