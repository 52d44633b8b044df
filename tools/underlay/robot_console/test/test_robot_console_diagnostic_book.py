# SPDX-License-Identifier: Apache-2.0
"""How parts of a robot are, the worst first."""

from __future__ import annotations

import pytest
from robot_console.panels.diagnostics import condition, DiagnosticBook, ERROR, OK, STALE, WARN


def test_worst_first() -> None:
    """Errors come first, then what is stale, then warnings; names decide among equals."""
    book = DiagnosticBook(stale_s=5.0)
    book.take('silent', condition(OK, 'fine', '', []), 0.0, 0.0)
    for name, level in (('b', OK), ('a', OK), ('warm', WARN), ('broken', ERROR)):
        book.take(name, condition(level, name, '', []), 5.5, 0.0)
    assert [(name, level) for name, level, _ in book.rows(6.0)] == [
        ('broken', ERROR),
        ('silent', STALE),
        ('warm', WARN),
        ('a', OK),
        ('b', OK),
    ]
    book.forget_stale(6.0)
    assert 'silent' not in [name for name, _, _ in book.rows(6.0)]


def test_details() -> None:
    """The details say what changed when, and what a stale part said last."""
    book = DiagnosticBook(stale_s=5.0)
    for second, level in enumerate((OK, OK, WARN, WARN, OK)):
        said = condition(level, f'at {second}', 'h1', [('volts', '24')])
        book.take('battery', said, float(second), 100.0 + second)
    details = book.details('battery', 20.0)
    assert details is not None
    assert (details['level'], details['said'], details['age']) == (STALE, OK, 16.0)
    assert (details['hardware'], details['values']) == ('h1', (('volts', '24'),))
    assert details['changes'] == [(100.0, OK, 'at 0'), (102.0, WARN, 'at 2'), (104.0, OK, 'at 4')]
    assert book.details('nobody', 20.0) is None


@pytest.mark.parametrize('level', [4, 7, 255])
def test_level_that_does_not_exist(level: int) -> None:
    """A level that does not exist is an error that says so."""
    said = condition(level, 'hm', '', [])
    assert said.level == ERROR and f'invalid level {level}' in said.message


def test_huge_messages() -> None:
    """Of thousands of parts, values and letters so many are kept as a page can show."""
    said = condition(OK, 'm' * 9999, 'h' * 9999, [('k', 'v' * 9999)] * 999)
    assert len(said.message) < 600 and len(said.hardware) < 600 and len(said.values) == 201
    assert said.values[-1] == ('...', '799 more values')
    book = DiagnosticBook()
    for number in range(1500):
        book.take(f'part {number}', said, 0.0, 0.0)
    assert len(book.rows(0.0)) == 1000 and book.left_out == 500
