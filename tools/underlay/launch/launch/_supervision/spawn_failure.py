# SPDX-License-Identifier: Apache-2.0
"""Error messages for processes that could not be started."""

from __future__ import annotations

from collections.abc import Mapping
import errno
import os
from typing import Any


def explain_spawn_failure(details: Mapping[str, Any], error: Exception) -> str:
    """
    Explain why a process could not be started, and what to do.

    Parameters
    ----------
    details
        `cmd` and `cwd` of the process.
    error
        The exception that was raised on start.

    Returns
    -------
    str
        The message for the log.

    """
    return f'exception occurred while executing process: {_reason(details, error)}'


def _reason(details: Mapping[str, Any], error: Exception) -> str:
    cwd, program = details['cwd'], details['cmd'][0]
    if cwd is not None and not os.path.isdir(cwd):
        return f"the folder '{cwd}', in which '{program}' was to be started, does not exist"
    if isinstance(error, FileNotFoundError):
        return _not_found(program)
    if isinstance(error, PermissionError):
        return f"'{program}' may not be executed; 'chmod +x' makes it executable"
    if getattr(error, 'errno', None) == errno.ENOEXEC:
        return f"'{program}' is a script whose first line does not name an interpreter (#!...)"
    return f"'{program}' cannot be started: {error}"


def _not_found(program: str) -> str:
    if not os.path.exists(program):
        where = 'does not exist' if '/' in program else 'was not found on the PATH'
        return f"the program '{program}' {where}"
    return f"'{program}' exists, but the interpreter that its first line names does not"
