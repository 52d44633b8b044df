# SPDX-License-Identifier: Apache-2.0
"""Assert what processes have written."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Optional, TYPE_CHECKING

from launch_testing.tools.text import Expected, matching_text
from launch_testing.util.resolve_processes import NO_CMD_ARGS, resolveProcesses, SomeProcess

if TYPE_CHECKING:
    from launch_testing.io_handler import IoHandler

__all__ = ['NO_CMD_ARGS', 'assertInStderr', 'assertInStdout', 'assertInStream']


def assertInStream(  # noqa: N802
    proc_output: IoHandler,
    expected_output: Expected,
    process: Optional[SomeProcess],
    cmd_args: Any = None,
    *,
    output_filter: Optional[Callable[[str], str]] = None,
    strict_proc_matching: bool = True,
    strip_ansi_escape_sequences: bool = True,
    stream: Optional[str] = None,
) -> None:
    """
    Assert that a process, or any if it is None, has written something to a stream.

    :param proc_output: what the processes have written
    :param expected_output: a text, a regular expression, a function, or a list of lines
    :param process: an action, a part of the name, or None
    :param cmd_args: an argument, or several, of the command line, or NO_CMD_ARGS for none
    :param output_filter: a function through which the output goes before
    :param strict_proc_matching: whether exactly one process must be meant
    :param strip_ansi_escape_sequences: whether colours are ignored
    :param stream: stdout, stderr, or None for any of both
    """
    chosen = resolveProcesses(
        proc_output, process=process, cmd_args=cmd_args, strict_proc_matching=strict_proc_matching
    )
    if not any(
        matching_text(
            proc_output,
            each,
            expected_output,
            stream=stream,
            output_filter=output_filter,
            strip_ansi_escape_sequences=strip_ansi_escape_sequences,
        )
        for each in chosen
    ):
        raise AssertionError(_complaint(proc_output, expected_output, chosen, stream))


def assertInStdout(  # noqa: N802
    proc_output: IoHandler,
    expected_output: Expected,
    process: Optional[SomeProcess],
    cmd_args: Any = None,
    **options: Any,
) -> None:
    """Assert that a process has written something to its standard output."""
    assertInStream(proc_output, expected_output, process, cmd_args, stream='stdout', **options)


def assertInStderr(  # noqa: N802
    proc_output: IoHandler,
    expected_output: Expected,
    process: Optional[SomeProcess],
    cmd_args: Any = None,
    **options: Any,
) -> None:
    """Assert that a process has written something to its standard error output."""
    assertInStream(proc_output, expected_output, process, cmd_args, stream='stderr', **options)


def _complaint(
    proc_output: IoHandler,
    expected: Expected,
    chosen: list[Any],
    stream: Optional[str],
) -> str:
    """Return what is missing, and what the processes have written last instead."""
    names = ', '.join(f"'{each.process_details['name']}'" for each in chosen) or 'any process'
    where = f' on {stream}' if stream else ''
    shown = getattr(expected, 'pattern', expected)
    return (
        f'{shown!r} was not found in the output of {names}{where}.'
        f'{proc_output.last_output(chosen)}'
    )
