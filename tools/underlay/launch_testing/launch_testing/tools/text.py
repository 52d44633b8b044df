# SPDX-License-Identifier: Apache-2.0
"""Match text with the expected output."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sized
import re
from typing import Any, Optional, TYPE_CHECKING, Union

if TYPE_CHECKING:
    from launch.actions import ExecuteLocal
    from launch_testing.io_handler import IoHandler

ExpectedLine = Union[str, re.Pattern[str], Callable[[str], Any]]
Expected = Union[ExpectedLine, Iterable[ExpectedLine]]
Match = Callable[[str], bool]

_ANSI_ESCAPE = re.compile(r'\x1b(?:\[[0-?]*[ -/]*[@-~]|[@-Z\\^_])')
_LINES_OR_TEXTS = 'a string, a compiled regular expression, a function, or a list of those'


def remove_ansi_escape_sequences(text: str) -> str:
    """
    Remove ANSI escape sequences, such as terminal colours, from a text.

    Parameters
    ----------
    text
        The text.

    """
    return _ANSI_ESCAPE.sub('', text)


def build_line_match(expected_line: ExpectedLine, *, strict: bool = False) -> Match:
    """
    Return a predicate that matches expected lines.

    Parameters
    ----------
    expected_line
        A string or a regular expression to find in the line, or a predicate.
    strict
        Whether the line must be equal to the string, or match the expression from its start.

    Raises
    ------
    ValueError
        The type of the expected output is not supported.

    """
    if isinstance(expected_line, str):
        if strict:
            return lambda line: line == expected_line
        return lambda line: expected_line in line
    if isinstance(expected_line, re.Pattern):
        search = expected_line.match if strict else expected_line.search
        return lambda line: search(line) is not None
    if callable(expected_line):
        return lambda line: bool(expected_line(line))
    raise ValueError(f'what is expected must be {_LINES_OR_TEXTS}, but it is {expected_line!r}')


def build_text_match(expected_text: Expected, *, strict: bool = False) -> Match:
    """
    Return a predicate that matches expected text.

    Parameters
    ----------
    expected_text
        A string, a regular expression or a predicate of the text, or a list of those for lines.
    strict
        As for `build_line_match`; in addition, a list must match without other lines in between.

    Raises
    ------
    ValueError
        The type of the expected output is not supported.

    """
    if isinstance(expected_text, (str, re.Pattern)) or callable(expected_text):
        return build_line_match(expected_text, strict=strict)
    if not isinstance(expected_text, Iterable):
        raise ValueError(
            f'what is expected must be {_LINES_OR_TEXTS}, but it is {expected_text!r}'
        )
    expected_lines = expected_text if isinstance(expected_text, Sized) else iter(expected_text)
    return lambda text: lines_match(text.splitlines(), expected_lines, strict=strict)


def lines_match(
    lines: list[str],
    expected_lines: Iterable[ExpectedLine],
    *,
    strict: bool,
) -> bool:
    """
    Whether lines match the expected ones, in this order.

    Parameters
    ----------
    lines
        The lines.
    expected_lines
        A string, a regular expression or a predicate for each line; may be infinite if `strict`.
    strict
        Whether each line must match, without other lines in between.

    """
    if strict:
        return _match_one_to_one(lines, expected_lines)
    rest = iter(lines)
    return all(any(map(build_line_match(expected), rest)) for expected in expected_lines)


def _match_one_to_one(lines: list[str], expected_lines: Iterable[ExpectedLine]) -> bool:
    if isinstance(expected_lines, Sized) and len(expected_lines) != len(lines):
        return False
    expected: Iterator[ExpectedLine] = iter(expected_lines)
    for line in lines:
        wanted = next(expected, None)
        if wanted is None or not build_line_match(wanted, strict=True)(line):
            return False
    return True


def matching_text(
    proc_output: IoHandler,
    process: ExecuteLocal,
    expected: Expected,
    *,
    stream: Optional[str],
    output_filter: Optional[Callable[[str], str]] = None,
    strip_ansi_escape_sequences: bool = True,
) -> bool:
    """
    Whether the output of a process so far matches the expected one.

    Parameters
    ----------
    proc_output
        The recorded output of the processes.
    process
        The action of the process.
    expected
        As for `build_text_match`.
    stream
        `stdout` or `stderr`; None matches either of them, or both together.
    output_filter
        Filter that is applied to the output first.
    strip_ansi_escape_sequences
        Whether ANSI colour codes are stripped.

    Raises
    ------
    ValueError
        The stream is unknown, or the type of the expected output is not supported.

    """
    if stream not in ('stdout', 'stderr', None):
        raise ValueError(f"the stream of a process is 'stdout' or 'stderr', not {stream!r}")
    if not isinstance(expected, (str, re.Pattern)) and not callable(expected):
        expected = list(expected)
    match = build_text_match(expected)
    for each in (stream,) if stream else ('stdout', 'stderr', None):
        text = proc_output.text(process, each)
        if strip_ansi_escape_sequences:
            text = remove_ansi_escape_sequences(text)
        if match(text if output_filter is None else output_filter(text)):
            return True
    return False
