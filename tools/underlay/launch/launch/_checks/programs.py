# SPDX-License-Identifier: Apache-2.0
"""Check that programs can be executed, and explain why one cannot, or why a command failed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
import errno
import os
import shlex
from typing import Any, Optional


class ProgramNotFoundError(FileNotFoundError):
    """A program does not exist or is not executable."""


def require_program(details: Mapping[str, Any]) -> None:
    """
    Check that the program of a process exists and is executable.

    A missing working directory only causes a warning, as it may be created before the start; if it
    is not, only this process fails.

    Parameters
    ----------
    details
        `name`, `cmd`, `cwd` and `env`, as `ExecuteLocal.description_of_process` returns them.

    Raises
    ------
    ProgramNotFoundError
        The program does not exist or is not executable.

    """
    program, folder = details['cmd'][0], details['cwd']
    if folder is not None and not os.path.isdir(folder):
        _warn_of_folder(details['name'], folder)
        return
    if not is_there(program, folder, details['env']):
        raise ProgramNotFoundError(explain_missing_program(program, folder, details['env']))


def _warn_of_folder(label: str, folder: str) -> None:
    from launch.logging import get_logger

    missing = 'is a file' if os.path.exists(folder) else 'does not exist'
    get_logger('launch').warning(
        "the folder '%s', in which process[%s] is to be started, %s", folder, label, missing
    )


def is_there(program: str, folder: Optional[str], env: Optional[Mapping[str, str]]) -> bool:
    """
    Whether a program exists and is executable.

    Parameters
    ----------
    program
        Its name, or its path.
    folder
        The working directory for relative paths; None for that of this process.
    env
        The environment whose PATH is searched; None for that of this process.

    """
    if os.path.dirname(program):
        return _is_program(os.path.join(folder or '', program))
    return find_program(program, env) is not None


def find_program(program: str, env: Optional[Mapping[str, str]] = None) -> Optional[str]:
    """
    Find a program on the PATH, as the shell does.

    `shutil.which` does the same, but shutil loads five compression libraries.

    Parameters
    ----------
    program
        Its name; a path is checked and returned as it is.
    env
        The environment whose PATH is searched; None for that of this process.

    Returns
    -------
    str or None
        The path of the program, None if it was not found.

    """
    if os.path.dirname(program):
        return program if _is_program(program) else None
    paths = (os.path.join(folder, program) for folder in _search_path(env).split(os.pathsep))
    return next(filter(_is_program, paths), None)


def _is_program(path: str) -> bool:
    return os.path.isfile(path) and os.access(path, os.X_OK)


def explain_missing_program(
    program: str,
    folder: Optional[str] = None,
    env: Optional[Mapping[str, str]] = None,
) -> str:
    """
    Explain that a program does not exist or is not executable.

    Parameters
    ----------
    program, folder, env
        As for `is_there`.

    Returns
    -------
    str
        The message, with a suggestion if there is one.

    """
    from ros_environment.missing_file import explain_missing_file
    from ros_environment.suggestions import did_you_mean

    if os.path.dirname(program):
        path = os.path.join(folder or '', program)
        if os.path.isfile(path):
            return f"'{program}' is not executable; 'chmod +x' makes it so"
        return explain_missing_file('program', path)
    names = (name for each in _search_path(env).split(os.pathsep) for name in _listed(each))
    text = f"the program '{program}' was not found on the PATH"
    hint = did_you_mean(program, names)
    if ' ' in program:
        hint = 'A command line in one text needs shell=True, or a list with an item for each word.'
    return f'{text}. {hint}' if hint else text


def _search_path(env: Optional[Mapping[str, str]]) -> str:
    return (os.environ if env is None else env).get('PATH', os.defpath)


def _listed(folder: str) -> list[str]:
    try:
        return os.listdir(folder or '.')
    except OSError:
        return []


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
        return f"'{program}' is not executable; 'chmod +x' makes it so"
    if getattr(error, 'errno', None) == errno.ENOEXEC:
        return f"'{program}' is a script whose first line does not name an interpreter (#!...)"
    return f"'{program}' cannot be started: {error}"


def _not_found(program: str) -> str:
    if not os.path.exists(program):
        where = 'does not exist' if '/' in program else 'was not found on the PATH'
        return f"the program '{program}' {where}"
    return f"'{program}' exists, but the interpreter that its first line names does not"


def advice_on_failure(parts: Sequence[str], said: str) -> str:
    """
    Advise on a failed command: a path split at a space, or one that does not exist.

    Parameters
    ----------
    parts
        The strings that were joined into the command line.
    said
        The error output of the command; advice that it already contains is not repeated.

    Returns
    -------
    str
        A line break and the advice, or '' if there is none.

    """
    return _split_path(parts) or _missing_path(''.join(parts), said)


def advice_on_program(parts: Sequence[str]) -> str:
    """
    Advise on a program that was not found because of a missing space after its name.

    Parameters
    ----------
    parts
        The strings that were joined into the command line.

    Returns
    -------
    str
        A line break and the advice, or '' if there is none.

    """
    import shutil

    first = parts[0].split()
    if len(parts) < 2 or not first or parts[0][-1].isspace() or shutil.which(first[-1]) is None:
        return ''
    return (
        f"\nIs a space missing after '{parts[0]}'? The parts of a command are joined as "
        f"they are: Command(['{parts[0]} ', ...])"
    )


def _split_path(parts: Sequence[str]) -> str:
    """Return advice on a path that was split into several words at a space."""
    words = shlex.split(''.join(parts))
    for part in parts[1:]:
        is_path = os.path.isabs(part) and len(part.split()) > 1
        if is_path and not any(part in word for word in words):
            return (
                f"\nThe path '{part}' contains a space, and was split into several words. "
                f"Quote it: Command(['{parts[0].rstrip()} \"', path, '\"'])"
            )
    return ''


def _missing_path(command: str, said: str) -> str:
    """Return advice on the first path that does not exist."""
    from ros_environment.missing_file import explain_missing_file

    for word in shlex.split(command)[1:]:
        if word.startswith('/') and not os.path.exists(word):
            explanation = explain_missing_file('file', word)
            return '' if explanation in said else f'\n{explanation}'
    return ''
