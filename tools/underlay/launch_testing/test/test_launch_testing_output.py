# SPDX-License-Identifier: Apache-2.0
"""Filters and expectations of output."""

from __future__ import annotations

from itertools import repeat
from pathlib import Path
import re
from typing import Any

from launch_testing.tools import (
    basic_output_filter,
    build_text_match,
    expect_output,
    expected_output_from_file,
)
import pytest


@pytest.mark.parametrize(
    ('expected', 'text', 'strict', 'result'),
    [
        (['b'], 'a\nb\nc', False, True),
        (['c', 'b'], 'a\nb\nc', False, False),
        (['b'], 'a\nb\nc', True, False),
        (['a', re.compile('b+')], 'a\nbbb', True, True),
        (['a', 'b', 'c'], 'a\nb', True, False),
        (repeat('a'), 'a\na\na', True, True),
        ([str.isdigit, 'x'], '12\nx', True, True),
        ([], '', True, True),
    ],
)
def test_expected_lines(expected: Any, text: str, strict: bool, result: bool) -> None:
    """Lines come in order; strictly, there are no others."""
    assert expect_output(expected_lines=expected, text=text, strict=strict) is result


def test_expected_text() -> None:
    """A text is a part of the output, or strictly all of it."""
    assert expect_output(expected_text='b', text='abc')
    assert not expect_output(expected_text='b', text='abc', strict=True)
    assert expect_output(expected_text=re.compile('a.c'), lines=['abc'], strict=True)
    assert expect_output(expected_text='a\nb', lines=['a', 'b'], strict=True)


def test_misuse() -> None:
    """What is missing or too much is said."""
    with pytest.raises(ValueError, match='either expected_text or expected_lines'):
        expect_output(text='x')
    with pytest.raises(ValueError, match='either text or lines'):
        expect_output(expected_text='x', text='x', lines=['x'])
    with pytest.raises(ValueError, match='must be a string.* but it is 5'):
        build_text_match(5)  # type: ignore[arg-type]


def test_filter() -> None:
    """Lines with a prefix, or that match a pattern, are dropped."""
    keep = basic_output_filter(['drop'], [r'.*secret'])
    assert keep('a\ndrop it\nmy secret\nb') == 'a\nb'
    assert basic_output_filter()('pid 5\nx') == 'x'


def test_expectation_from_file(tmp_path: Path) -> None:
    """A file holds lines, or regular expressions; without one the error names both."""
    (tmp_path / 'a.txt').write_text('x\ny\n')
    (tmp_path / 'b.regex').write_text('x+\n')
    assert expected_output_from_file(tmp_path / 'a') == ['x', 'y']
    assert expected_output_from_file(str(tmp_path / 'b')) == [re.compile('x+')]
    with pytest.raises(RuntimeError, match="neither in '.*c.txt' nor in '.*c.regex'"):
        expected_output_from_file(tmp_path / 'c')
