# SPDX-License-Identifier: Apache-2.0
"""Assertions about sequences in the output of a process."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
import re
from typing import Any, Optional, TYPE_CHECKING, Union

from launch_testing.tools.text import remove_ansi_escape_sequences
from launch_testing.util.resolve_processes import resolveProcesses, SomeProcess

if TYPE_CHECKING:
    from launch_testing.io_handler import IoHandler


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
                f"{shown!r} was not found in the output of '{self._name}' behind "
                f'{self._found or "its beginning"}. There follows:\n{rest}'
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
