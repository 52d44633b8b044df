# SPDX-License-Identifier: Apache-2.0
"""Resolve the processes of a launch by action, name or arguments."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Final, Optional, Protocol, TYPE_CHECKING, Union

from launch.actions.execute_local import ExecuteLocal

if TYPE_CHECKING:
    SomeProcess = Union[ExecuteLocal, str]
else:
    SomeProcess = object


class _NoCmdArgs:
    """The type of NO_CMD_ARGS."""

    def __repr__(self) -> str:
        return 'NO_CMD_ARGS'


NO_CMD_ARGS: Final = _NoCmdArgs()


class NoMatchingProcessException(Exception):
    """No process, or more than one, matches the criteria of a test."""


class _Handler(Protocol):
    """Protocol of handlers with a list of processes."""

    def processes(self) -> list[ExecuteLocal]:
        """Return the actions of the processes."""


def resolveProcesses(  # noqa: N802
    info_obj: _Handler,
    *,
    process: Optional[SomeProcess] = None,
    cmd_args: Any = None,
    strict_proc_matching: bool = True,
) -> list[ExecuteLocal]:
    """
    Resolve processes by action, name or command line arguments.

    Parameters
    ----------
    info_obj
        The handler of the processes: `proc_info` or `proc_output`.
    process
        The action of a process, a substring of its name, or None for all.
    cmd_args
        One or several arguments that the command line must contain; NO_CMD_ARGS for none.
    strict_proc_matching
        Whether exactly one process must match, unless `process` is None.

    Returns
    -------
    list of ExecuteLocal
        The actions of the processes.

    Raises
    ------
    NoMatchingProcessException
        No process matches, or more than one in strict mode.
    TypeError
        The process is given by an object of another type.

    """
    known = info_obj.processes()
    found = [each for each in known if _is_meant(each, process) and _has(each, cmd_args)]
    if process is None:
        return found
    if not found:
        raise NoMatchingProcessException(
            f'No process is {_wanted(process, cmd_args)}. There are: {_names(known)}'
        )
    if strict_proc_matching and len(found) > 1:
        raise NoMatchingProcessException(
            f'More than one process is {_wanted(process, cmd_args)}: {_names(found)}. '
            'Name one of them, give its cmd_args, or pass strict_proc_matching=False'
        )
    return found


def _is_meant(action: ExecuteLocal, process: Optional[SomeProcess]) -> bool:
    if isinstance(process, str):
        return process in (action.process_details or {})['name']
    if process is None or isinstance(process, ExecuteLocal):
        return process is None or action is process
    raise TypeError(
        f'a process is given by its action or its name, not by {process!r}, which is a '
        f'{type(process).__name__}'
    )


def _has(action: ExecuteLocal, cmd_args: Any) -> bool:
    """Whether the command line of a process contains the given arguments."""
    command = (action.process_details or {})['cmd']
    if cmd_args is None:
        return True
    if cmd_args is NO_CMD_ARGS:
        return len(command) == 1
    wanted = [cmd_args] if isinstance(cmd_args, str) else list(cmd_args)
    return all(argument in command for argument in wanted)


def _wanted(process: Optional[SomeProcess], cmd_args: Any) -> str:
    what = repr(process) if isinstance(process, str) else f'that of {process!r}'
    return what if cmd_args is None else f'{what} with the arguments {cmd_args!r}'


def _names(actions: Iterable[ExecuteLocal]) -> str:
    return ', '.join((each.process_details or {})['name'] for each in actions) or 'none'
