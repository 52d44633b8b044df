# SPDX-License-Identifier: Apache-2.0
"""The report of a check: one line per criterion, details of what is not met, and a summary."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from humanoid_course.grading import Criterion, Exercise, Outcome, Results, Verdict

_WIDTH = max(len(outcome.value) for outcome in Outcome)
_MOST_CHARACTERS = 600


def result_lines(criterion: Criterion[Any], verdict: Verdict) -> list[str]:
    """
    Format the verdict on a criterion; one that is not met has lines of details below it.

    Parameters
    ----------
    criterion
        The criterion.
    verdict
        Its verdict.

    """
    head = f'{verdict.outcome.value:{_WIDTH}}  {criterion.name}: {criterion.text}'
    if verdict.outcome is Outcome.PASSED:
        return [f'{head} ({_one_line(verdict.found)})']
    label = 'found' if verdict.outcome is Outcome.FAILED else 'because'
    details = [(label, verdict.found), ('expected', verdict.expected), ('next', verdict.advice)]
    indent = ' ' * (_WIDTH + 2)
    return [head, *(f'{indent}{name}: {_one_line(text)}' for name, text in details if text)]


def summary(exercise: Exercise[Any], results: Results) -> str:
    """
    Sum up the verdicts in a sentence.

    Parameters
    ----------
    exercise
        The exercise.
    results
        The verdicts on its criteria.

    """
    total = len(exercise.criteria)
    if is_complete(exercise, results):
        return f'{exercise.name}: all {total} criteria are passed.'
    counts = [
        f'{count} {outcome.value}'
        for outcome in Outcome
        if (count := sum(verdict.outcome is outcome for verdict in results.values()))
    ]
    return f'{exercise.name}: of {total} criteria, {", ".join(counts)}.'


def is_complete(exercise: Exercise[Any], results: Results) -> bool:
    """
    Whether every criterion of an exercise is passed.

    Parameters
    ----------
    exercise
        The exercise.
    results
        The verdicts on its criteria.

    """
    verdicts = [results.get(criterion.name) for criterion in exercise.criteria]
    return all(verdict and verdict.outcome is Outcome.PASSED for verdict in verdicts)


def listing(exercises: Iterable[Exercise[Any]]) -> list[str]:
    """
    List exercises with their criteria.

    Parameters
    ----------
    exercises
        The exercises.

    """
    lines: list[str] = []
    for exercise in exercises:
        lines.append(f'{exercise.name}: {exercise.title} ({", ".join(exercise.packages)})')
        lines.extend(f'  {each.name}: {each.text}' for each in exercise.criteria)
        lines.append('')
    return [*lines, 'Check your package with: ros2 run humanoid_course check EXERCISE']


def quoted(names: Sequence[str], most: int = 8) -> str:
    """
    Join names with commas, leaving out those that are too many.

    Parameters
    ----------
    names
        The names.
    most
        How many to show.

    """
    rest = [f'{len(names) - most} more'] if len(names) > most else []
    return ', '.join([*names[:most], *rest]) or 'none'


def _one_line(text: str) -> str:
    """Keep a text that contains output of a program on one line of limited length."""
    line = ' '.join(''.join(c if c.isprintable() else ' ' for c in text).split())
    return line if len(line) <= _MOST_CHARACTERS else f'{line[:_MOST_CHARACTERS]}...'
