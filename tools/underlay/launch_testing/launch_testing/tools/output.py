# SPDX-License-Identifier: Apache-2.0
"""Filter and match the output of processes."""

from __future__ import annotations

from collections.abc import Callable, Iterable
import os
import re
from typing import Optional, Union

from launch_testing.tools.text import (
    build_text_match,
    Expected,
    ExpectedLine,
    lines_match,
    Match,
)

__all__ = [
    'basic_output_filter',
    'expect_output',
    'expected_output_from_file',
    'get_default_filtered_patterns',
    'get_default_filtered_prefixes',
]


def get_default_filtered_prefixes() -> list[str]:
    """Return the prefixes of lines that tests ignore by default."""
    return ['pid', 'rc']


def get_default_filtered_patterns() -> list[str]:
    """Return the regular expressions of lines that tests ignore by default."""
    return []


def basic_output_filter(
    filtered_prefixes: Optional[Iterable[str]] = None,
    filtered_patterns: Optional[Iterable[Union[str, re.Pattern[str]]]] = None,
) -> Callable[[str], str]:
    """
    Return a function that removes lines from an output.

    Parameters
    ----------
    filtered_prefixes
        The prefixes of lines to remove; None for the defaults.
    filtered_patterns
        Regular expressions of lines to remove, matched from the start; None for the defaults.

    """
    if filtered_prefixes is None:
        filtered_prefixes = get_default_filtered_prefixes()
    if filtered_patterns is None:
        filtered_patterns = get_default_filtered_patterns()
    prefixes = tuple(filtered_prefixes)
    patterns = [re.compile(pattern) for pattern in filtered_patterns]

    def is_kept(line: str) -> bool:
        return not (line.startswith(prefixes) or any(pattern.match(line) for pattern in patterns))

    return lambda text: ''.join(filter(is_kept, text.splitlines(keepends=True)))


def expect_output(
    *,
    expected_text: Optional[Expected] = None,
    expected_lines: Optional[Iterable[ExpectedLine]] = None,
    text: Optional[str] = None,
    lines: Optional[Iterable[str]] = None,
    strict: bool = False,
) -> bool:
    """
    Whether an output matches the expected one.

    Either `expected_text` or `expected_lines` is given, and either `text` or `lines`.

    Parameters
    ----------
    expected_text
        A string, a regular expression or a predicate of the output, or a list of those for lines.
    expected_lines
        A string, a regular expression or a predicate for each line.
    text, lines
        The output, as a whole or as lines.
    strict
        Whether additional output is rejected.

    Raises
    ------
    ValueError
        Both or neither of two alternatives are given.

    """
    if (expected_text is None) == (expected_lines is None):
        raise ValueError('expect_output() needs either expected_text or expected_lines')
    if (text is None) == (lines is None):
        raise ValueError('expect_output() needs either text or lines')
    found = (text or '').splitlines() if lines is None else list(lines)
    if expected_lines is not None:
        return lines_match(found, expected_lines, strict=strict)
    match: Match = build_text_match(expected_text or '', strict=strict)
    return match('\n'.join(found) if text is None else text)


def expected_output_from_file(path: Union[str, os.PathLike[str]]) -> list[ExpectedLine]:
    """
    Read the expected output from a file with the suffix `.txt` or `.regex`.

    Parameters
    ----------
    path
        The file without its suffix.

    Returns
    -------
    list of ExpectedLine
        The lines of `path.txt`, or those of `path.regex` as regular expressions.

    Raises
    ------
    RuntimeError
        Neither file exists.

    """
    literal, regex = (f'{os.fspath(path)}.{suffix}' for suffix in ('txt', 'regex'))
    if os.path.exists(literal):
        return list(_lines(literal))
    if os.path.exists(regex):
        return [re.compile(line) for line in _lines(regex)]
    raise RuntimeError(f"the expected output is neither in '{literal}' nor in '{regex}'")


def _lines(path: str) -> list[str]:
    with open(path, encoding='utf-8') as file:
        return file.read().splitlines()
