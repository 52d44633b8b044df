# SPDX-License-Identifier: Apache-2.0
"""Check the order of the checks, and how they are reported."""

from __future__ import annotations

from humanoid_course.check import EXERCISES
from humanoid_course.grading import Criterion, Exercise, failed, grade, passed, Verdict
from humanoid_course.report import is_complete, listing, quoted, result_lines, summary


def met(_: str) -> Verdict:
    """Pass."""
    return passed('a')


def not_met(_: str) -> Verdict:
    """Fail with the output of a program."""
    return failed('line\nline\x1b[0m', 'b', 'Do c.')


def refused(_: str) -> Verdict:
    """Run into a full disk."""
    raise OSError(28, 'No space left on device')


CRITERIA = (
    Criterion('one', 'the first holds', met),
    Criterion('two', 'the second holds', not_met, ('one',)),
    Criterion('three', 'the third holds', met, ('two',)),
    Criterion('four', 'the fourth holds', refused, ('one',)),
)
EXERCISE = Exercise[str]('exercise_9', 'do nothing', ('p',), CRITERIA)


def test_lines() -> None:
    """Each criterion has a line; what is not met has details, each on one line."""
    lines = [line for each in grade(EXERCISE, '') for line in result_lines(*each)]
    assert lines == [
        'passed                one: the first holds (a)',
        'not passed            two: the second holds',
        '                      found: line line [0m',
        '                      expected: b',
        '                      next: Do c.',
        'could not be checked  three: the third holds',
        "                      because: it builds on 'two', which is not met",
        "                      next: Correct 'two' first, then check again.",
        'could not be checked  four: the fourth holds',
        '                      because: the system reported: [Errno 28] No space left on device',
        '                      next: Correct that (disk, memory, permissions, network), then '
        'check again.',
    ]


def test_summary() -> None:
    """The summary counts; an exercise is complete only with all verdicts."""
    results = {each.name: verdict for each, verdict in grade(EXERCISE, '')}
    expected = 'exercise_9: of 4 criteria, 1 passed, 1 not passed, 2 could not be checked.'
    assert summary(EXERCISE, results) == expected
    good = {each.name: passed('') for each in CRITERIA}
    assert summary(EXERCISE, good) == 'exercise_9: all 4 criteria are passed.'
    assert is_complete(EXERCISE, good)
    del good['three']
    assert not is_complete(EXERCISE, good)


def test_listing() -> None:
    """Every criterion of every exercise is listed with its sentence."""
    lines = listing(EXERCISES.values())
    for exercise in EXERCISES.values():
        assert any(line.startswith(f'{exercise.name}: ') for line in lines)
        assert all(f'  {each.name}: {each.text}' in lines for each in exercise.criteria)


def test_needs_come_first() -> None:
    """A criterion needs only those that are checked before it."""
    for exercise in EXERCISES.values():
        names = [each.name for each in exercise.criteria]
        for index, criterion in enumerate(exercise.criteria):
            assert set(criterion.needs) <= set(names[:index])


def test_many_names() -> None:
    """Long lists are cut, empty ones said."""
    assert quoted(['a', 'b', 'c'], 2) == 'a, b, 1 more'
    assert quoted([]) == 'none'
