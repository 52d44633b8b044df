# SPDX-License-Identifier: Apache-2.0
"""Assertions about the exit codes of processes."""

from __future__ import annotations

from collections.abc import Collection
import signal
from typing import Any, Optional, TYPE_CHECKING

from launch.events.process import ProcessExited
from launch_testing.util.resolve_processes import resolveProcesses, SomeProcess

if TYPE_CHECKING:
    from launch_testing.proc_info_handler import ProcInfoHandler

_BY_SIGNAL = 128

EXIT_OK = 0
EXIT_FORCED = 1
EXIT_SIGINT = _BY_SIGNAL + signal.SIGINT
EXIT_SIGQUIT = _BY_SIGNAL + signal.SIGQUIT
EXIT_SIGKILL = _BY_SIGNAL + signal.SIGKILL
EXIT_SIGSEGV = _BY_SIGNAL + signal.SIGSEGV


def assertExitCodes(  # noqa: N802
    proc_info: ProcInfoHandler,
    allowable_exit_codes: Collection[int] = (EXIT_OK,),
    process: Optional[SomeProcess] = None,
    cmd_args: Any = None,
    *,
    strict_proc_matching: bool = True,
) -> None:
    """
    Assert that a process, or every process, has ended with an allowed exit code.

    The exit code of a process ended by signal n is -n, or 128 + n as in a shell.

    Parameters
    ----------
    proc_info
        The recorder of process starts and exits.
    allowable_exit_codes
        The allowed exit codes.
    process, cmd_args, strict_proc_matching
        As for `resolveProcesses`; without a process, all processes are checked.

    Raises
    ------
    AssertionError
        A process has ended with a different exit code, or has not ended.
    NoMatchingProcessException
        No process matches, or more than one.
    TypeError
        The exit codes are not a collection.

    """
    if isinstance(allowable_exit_codes, (str, int)):
        raise TypeError(f'the allowable exit codes must be a list, not {allowable_exit_codes!r}')
    chosen = resolveProcesses(
        proc_info, process=process, cmd_args=cmd_args, strict_proc_matching=strict_proc_matching
    )
    wrong = [
        text
        for info in map(proc_info.__getitem__, chosen)
        for text in _complaint(info, set(allowable_exit_codes))
    ]
    if wrong:
        allowed = ', '.join(str(int(code)) for code in allowable_exit_codes)
        raise AssertionError(f'{"; ".join(wrong)}. Allowed are: {allowed}')


def _complaint(info: Any, allowed: set[int]) -> list[str]:
    """Return an error message in a list if the exit code is not allowed, else no message."""
    if not isinstance(info, ProcessExited):
        return [f"the process '{info.process_name}' has not ended"]
    code = info.returncode
    if code in allowed or (code < 0 and _BY_SIGNAL - code in allowed):
        return []
    return [f"the process '{info.process_name}' ended with exit code {code}{_signal_name(code)}"]


def _signal_name(code: int) -> str:
    if code >= 0:
        return ''
    try:
        return f' ({signal.Signals(-code).name})'
    except ValueError:
        return f' (signal {-code})'
