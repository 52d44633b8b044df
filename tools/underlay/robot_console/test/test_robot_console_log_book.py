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
    for text in 'abcde':
        book.add(line(text, 40 if text == 'a' else 20))
    assert [each.text for each in book.since(0)] == ['c', 'd', 'e']
    assert [each.text for each in book.since(4)] == ['e']
    assert book.since(5) == []
    assert book.counts == {20: 4, 40: 1}
    assert book.news(3)['nodes'] == ['arm']


def test_a_line_that_repeats_is_kept_once() -> None:
    """It is counted by node, level and text, even if others log between, and moves to the end."""
    book = LogBook(kept=3)
    book.add(line('rare'))
    for second in range(100):
        book.add(LogLine(float(second), 20, 'arm', 'hot'))
        book.add(LogLine(float(second), 20, 'leg', 'hot'))
    assert [(each.node, each.text, each.times) for each in book.since(0)] == [
        ('arm', 'rare', 1),
        ('arm', 'hot', 100),
        ('leg', 'hot', 100),
    ]
    assert [each.time_s for each in book.since(200)] == [99.0]
    assert book.counts == {20: 201}
    first = book.since(0)[0]
    kept = book.add(line('rare'))
    assert kept is not None and (kept.times, kept.number) == (2, first.number)
    assert book.since(0)[-1] == kept and book.since(book.count - 1) == [kept]
    for other in (line('rare', 30), line('Rare'), line('rare', node='head')):
        kept = book.add(other)
        assert kept is not None and kept.times == 1


def test_digits_make_no_other_line() -> None:
    """Texts that differ in digits only are counted as one, with the newest numbers."""
    book = LogBook()
    book.add(line('joint 3 is at 99.5 degrees'))
    kept = book.add(line('joint 12 is at 100.25 degrees'))
    assert book.since(0) == [kept]
    assert kept is not None and kept.text == 'joint 12 is at 100.25 degrees' and kept.times == 2
    book.add(line('joint 3 is at 99.5 radians'))
    book.add(line('joint 3 is at -99.5 degrees'))
    assert [each.times for each in book.since(0)] == [2, 1, 1]
    numbers = [each.number for each in book.since(0)]
    assert len(set(numbers)) == 3


def test_a_line_that_was_forgotten_begins_anew() -> None:
    """The one that was not logged for longest goes first, and is then counted from one."""
    book = LogBook(kept=2)
    for text in 'abac':
        book.add(line(text))
    assert [(each.text, each.times) for each in book.since(0)] == [('a', 2), ('c', 1)]
    again = book.add(line('b'))
    assert again is not None and (again.times, again.number) == (1, 5)


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
