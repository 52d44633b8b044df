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
    Assert that a process has written some output to a stream.

    Parameters
    ----------
    proc_output
        What the processes have written.
    expected_output
        A text, a regular expression, a function of the output, or a list of those for its lines.
    process, cmd_args
        As for `resolveProcesses`; without a process, any of them is enough.
    output_filter
        A function that the output goes through first.
    strict_proc_matching
        Whether exactly one process must be meant.
    strip_ansi_escape_sequences
        Whether colours are ignored.
    stream
        `stdout` or `stderr`; None accepts each of them, and both together.

    Raises
    ------
    AssertionError
        The output is not there; the text shows the last lines.
    NoMatchingProcessException
        No process, or more than one, is the one meant.

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
    """
    Assert that a process has written some output to its standard output.

    Parameters
    ----------
    proc_output, expected_output, process, cmd_args
        As for `assertInStream`.
    **options
        Its other arguments, except for `stream`.

    Raises
    ------
    AssertionError
        The output is not there.

    """
    assertInStream(proc_output, expected_output, process, cmd_args, stream='stdout', **options)


def assertInStderr(  # noqa: N802
    proc_output: IoHandler,
    expected_output: Expected,
    process: Optional[SomeProcess],
    cmd_args: Any = None,
    **options: Any,
) -> None:
    """
    Assert that a process has written some output to its standard error output.

    Parameters
    ----------
    proc_output, expected_output, process, cmd_args
        As for `assertInStream`.
    **options
        Its other arguments, except for `stream`.

    Raises
    ------
    AssertionError
        The output is not there.

    """
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
