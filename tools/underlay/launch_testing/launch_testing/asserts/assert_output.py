# SPDX-License-Identifier: Apache-2.0
"""Assertions about the output of processes: that texts occur in it, also in sequence."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
import re
from typing import Any, Optional, TYPE_CHECKING, Union

from launch_testing.tools.text import Expected, matching_text, remove_ansi_escape_sequences
from launch_testing.util.resolve_processes import NO_CMD_ARGS, resolveProcesses, SomeProcess

if TYPE_CHECKING:
    from launch_testing.io_handler import IoHandler

__all__ = [
    'NO_CMD_ARGS',
    'SequentialTextChecker',
    'assertInStderr',
    'assertInStdout',
    'assertInStream',
    'assertSequentialStdout',
]


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
    Assert that a stream of a process contains the expected output.

    Parameters
    ----------
    proc_output
        The recorded output of the processes.
    expected_output
        A string, a regular expression or a predicate of the output, or a list of those for lines.
    process, cmd_args
        As for `resolveProcesses`; without a process, the output of any process matches.
    output_filter
        Filter that is applied to the output first.
    strict_proc_matching
        Whether exactly one process must match.
    strip_ansi_escape_sequences
        Whether ANSI colour codes are stripped.
    stream
        `stdout` or `stderr`; None matches either of them, or both together.

    Raises
    ------
    AssertionError
        The output was not found; the message shows the last lines.
    NoMatchingProcessException
        No process matches, or more than one.

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
    Assert that the standard output of a process contains the expected output.

    Parameters
    ----------
    proc_output, expected_output, process, cmd_args
        As for `assertInStream`.
    **options
        Its other arguments, except for `stream`.

    Raises
    ------
    AssertionError
        The output was not found.

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
    Assert that the standard error of a process contains the expected output.

    Parameters
    ----------
    proc_output, expected_output, process, cmd_args
        As for `assertInStream`.
    **options
        Its other arguments, except for `stream`.

    Raises
    ------
    AssertionError
        The output was not found.

    """
    assertInStream(proc_output, expected_output, process, cmd_args, stream='stderr', **options)


def _complaint(
    proc_output: IoHandler,
    expected: Expected,
    chosen: list[Any],
    stream: Optional[str],
) -> str:
    """Return an error message with the expected and the last actual output."""
    names = ', '.join(f"'{each.process_details['name']}'" for each in chosen) or 'any process'
    where = f' on {stream}' if stream else ''
    shown = getattr(expected, 'pattern', expected)
    return (
        f'{shown!r} was not found in the output of {names}{where}.'
        f'{proc_output.last_output(chosen)}'
    )


class SequentialTextChecker:
    """
    Checker that texts occur in sequence.

    Parameters
    ----------
    text
        The output of a process.
    name
        The name of the process, for error messages.

    """

    def __init__(self, text: str, name: str) -> None:
        self._rest = text
        self._name = name
        self._found: list[str] = []

    def assertInStdout(  # noqa: N802
        self,
        expected_output: Union[str, re.Pattern[str]],
        output_filter: Optional[Callable[[str], str]] = None,
    ) -> None:
        """
        Assert that a text occurs after all texts found so far.

        Parameters
        ----------
        expected_output
            The text or a regular expression.
        output_filter
            Filter that is applied to the remaining output first.

        Raises
        ------
        AssertionError
            The text does not follow; the message shows the remaining output.

        """
        rest = self._rest if output_filter is None else output_filter(self._rest)
        pattern = (
            re.compile(re.escape(expected_output))
            if isinstance(expected_output, str)
            else expected_output
        )
        match = pattern.search(rest)
        shown = expected_output if isinstance(expected_output, str) else expected_output.pattern
        if match is None:
            raise AssertionError(
                f"{shown!r} was not found in the output of '{self._name}' after "
                f'{self._found or "its beginning"}. It continues with:\n{rest}'
            )
        self._found.append(shown)
        end = match.end()
        self._rest = rest[end:]


@contextmanager
def assertSequentialStdout(  # noqa: N802
    proc_output: IoHandler,
    process: SomeProcess,
    cmd_args: Any = None,
) -> Iterator[SequentialTextChecker]:
    """
    Return a context manager to assert that texts occur in sequence in the standard output.

    Parameters
    ----------
    proc_output
        The recorded output of the processes.
    process, cmd_args
        As for `resolveProcesses`; exactly one process must match.

    Yields
    ------
    SequentialTextChecker
        The checker, to be called for each text in sequence.

    Raises
    ------
    NoMatchingProcessException
        No process matches, or more than one.

    """
    (action,) = resolveProcesses(proc_output, process=process, cmd_args=cmd_args)
    text = remove_ansi_escape_sequences(proc_output.text(action, 'stdout'))
    yield SequentialTextChecker(text, (action.process_details or {})['name'])
