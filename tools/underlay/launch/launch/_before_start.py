# SPDX-License-Identifier: Apache-2.0
"""
What is checked before the first process of a launch starts, and why a program cannot be started.

Checks are added while the description is visited. The last one names installed files that are
older than their source.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
import errno
import os
from typing import Any, Optional, TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    import logging

    from launch.launch_context import LaunchContext

_SHARE = '/share/'
SWITCH = 'LAUNCH_PREFLIGHT'

_Check = TypeVar('_Check')


class BeforeStart:
    """Pre-start checks of a launch; if one raises an error, no process is started."""

    def __init__(self) -> None:
        """Create an empty set of checks; LAUNCH_PREFLIGHT=0 disables the check for programs."""
        self.resolves_programs = os.environ.get(SWITCH, '1') != '0'
        self.checks: list[Callable[[LaunchContext], None]] = []
        self.hints: list[Callable[[LaunchContext], str]] = []
        self.files: dict[str, None] = {}

    def check_of_type(self, kind: Callable[[], _Check]) -> _Check:
        """
        Get the check of a class; create it on first use.

        Parameters
        ----------
        kind
            The class; its instances are called with the context and raise an error on failure.

        """
        for check in self.checks:
            if isinstance(check, kind):  # type: ignore[arg-type]
                return check  # type: ignore[return-value]
        added: Any = kind()
        self.checks.append(added)
        return added  # type: ignore[no-any-return]

    def run(self, context: LaunchContext, logger: logging.Logger) -> None:
        """
        Run the added checks, then warn about installed files that are older than their source.

        Parameters
        ----------
        context
            The context of the launch, whose first description has been visited.
        logger
            The logger for the warnings.

        Raises
        ------
        Exception
            The error raised by a check.

        """
        for check in self.checks:
            check(context)
        installed = [path for path in self.files if _SHARE in path]
        if installed:
            warn_of_stale_files(installed, logger)

    def explain_failure(self, context: LaunchContext) -> list[str]:
        """
        Collect hints on why a visit may have failed.

        Parameters
        ----------
        context
            The context of the launch, passed to each hint.

        Returns
        -------
        list of str
            Lines for the log; empty hints are omitted.

        """
        return [text for text in (hint(context) for hint in self.hints) if text]


def warn_of_stale_files(paths: Iterable[str], logger: logging.Logger) -> None:
    """
    Warn about installed files whose source is newer and differs.

    Parameters
    ----------
    paths
        The paths of the installed files.
    logger
        The logger for the warnings.

    """
    from ros_environment.source_tree import StaleFiles

    files = StaleFiles()
    for path in paths:
        source = files.newer_source(path)
        if source:
            logger.warning(
                "'%s' is newer than the installed '%s', which is used; run colcon build",
                source,
                path,
            )


def note_files_of_command(context: LaunchContext, command: str) -> None:
    """
    Record the installed files that a command line names, such as a model for xacro.

    Parameters
    ----------
    context
        The context that records them; nothing is recorded once the checks have run.
    command
        The command line, which is split as a shell does.

    """
    if context.run.before_start is None or _SHARE not in command:
        return
    import shlex

    for word in shlex.split(command):
        if _SHARE in word and os.path.isfile(word):
            context.run.note_file(word)


class ProgramNotFoundError(FileNotFoundError):
    """A program does not exist or is not executable."""


def require_program(details: Mapping[str, Any], logger: logging.Logger) -> None:
    """
    Check that the program of a process exists and is executable.

    A missing working directory only causes a warning, as it may be created before the start; if it
    is not, only this process fails.

    Parameters
    ----------
    details
        `name`, `cmd`, `cwd` and `env`, as `ExecuteLocal.description_of_process` returns them.
    logger
        The logger for the warning.

    Raises
    ------
    ProgramNotFoundError
        The program does not exist or is not executable.

    """
    program, folder = details['cmd'][0], details['cwd']
    if folder is not None and not os.path.isdir(folder):
        logger.warning(
            "the folder '%s', in which process[%s] is to be started, %s",
            folder,
            details['name'],
            'is a file' if os.path.exists(folder) else 'does not exist',
        )
        return
    if not is_there(program, folder, details['env']):
        raise ProgramNotFoundError(explain_missing_program(program, folder, details['env']))


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
