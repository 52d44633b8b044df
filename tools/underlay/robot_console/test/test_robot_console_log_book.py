# SPDX-License-Identifier: Apache-2.0
"""What is kept of what nodes say, and what is worth an interruption."""

from __future__ import annotations

from robot_console.panels.log import Interruptions, LogBook, LogLine


def line(text: str = 'x', level: int = 20, node: str = 'arm') -> LogLine:
    """Return what a node says."""
    return LogLine(1.0, level, node, text)


def test_newest_are_kept() -> None:
    """The newest lines are kept, and all are counted."""
    book = LogBook(kept=3)
    for number in range(5):
        book.add(line(str(number), 40 if number == 0 else 20))
    assert [each.text for each in book.since(0)] == ['2', '3', '4']
    assert [each.text for each in book.since(4)] == ['4']
    assert book.since(5) == []
    assert book.counts == {20: 4, 40: 1}
    assert book.news(3)['nodes'] == ['arm']


def test_namespace() -> None:
    """Only nodes below the namespace count; a name that begins alike is another one."""
    book = LogBook(namespace='lab/robot1')
    for node in ('lab.robot1.arm', 'lab.robot1', 'lab.robot12.arm', 'arm'):
        book.add(line(node=node))
    assert [each.node for each in book.since(0)] == ['lab.robot1.arm', 'lab.robot1']


def test_odd_lines() -> None:
    """Levels that do not exist are those next to them, and long texts are cut."""
    book = LogBook()
    assert [book.add(line(level=level)).level for level in (0, 25, 77, 255)] == [10, 20, 50, 50]
    kept = book.add(line('a' * 5000))
    assert kept.text.endswith('a ... (3000 characters more)') and len(kept.text) < 2100


def test_interruptions() -> None:
    """The first error interrupts at once; those that follow together, after a while."""
    errors = Interruptions(period_s=5.0, silence_s=60.0)
    errors.add(line('fine'), 0.0)
    assert errors.due(0.0) is None
    errors.add(line('broken', 40), 0.0)
    assert errors.due(0.0) == ('Error of arm', 'broken')
    for number in range(3):
        errors.add(line(f'broken {number}', 50), 1.0)
    assert errors.due(4.9) is None
    assert errors.due(5.1) == ('Error of arm', 'broken 0 (2 more: see Log)')
    assert errors.due(99.0) is None


def test_same_error_again() -> None:
    """An error that is said all the time interrupts once, and again after a silence."""
    errors = Interruptions(period_s=1.0, silence_s=10.0)
    for second in range(100):
        errors.add(line('broken', 40), float(second))
        assert (errors.due(float(second)) is not None) == (second == 0)
    errors.add(line('broken', 40), 111.0)
    assert errors.due(111.0) == ('Error of arm', 'broken')
