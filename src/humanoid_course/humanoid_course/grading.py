# SPDX-License-Identifier: Apache-2.0
"""What an exercise asks for: criteria as data, their verdicts, and the order of the checks."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from enum import Enum
from typing import Generic, TypeVar

SubmissionT = TypeVar('SubmissionT')


class Outcome(Enum):
    """How the check of a criterion ended, in the words of the report."""

    PASSED = 'passed'
    FAILED = 'not passed'
    UNCHECKED = 'could not be checked'


@dataclass(frozen=True)
class Verdict:
    """The outcome of a check, with what was found, what was expected, and what to do next."""

    outcome: Outcome
    found: str
    expected: str = ''
    advice: str = ''


@dataclass(frozen=True)
class Criterion(Generic[SubmissionT]):
    """
    A criterion of an exercise.

    name: unique within the exercise; text: what is checked, as a sentence without its full stop;
    check: looks at a submission; needs: names of criteria without which the check says nothing.
    """

    name: str
    text: str
    check: Callable[[SubmissionT], Verdict]
    needs: tuple[str, ...] = ()


@dataclass(frozen=True)
class Exercise(Generic[SubmissionT]):
    """
    An exercise of the course.

    packages: the names of the packages that it asks for, first the one with the launch file;
    launch_words: words by which to tell its launch file from others of the package.
    """

    name: str
    title: str
    packages: tuple[str, ...]
    criteria: tuple[Criterion[SubmissionT], ...]
    launch_words: tuple[str, ...] = ()


Results = dict[str, Verdict]
"""Verdicts by the name of the criterion, in the order of the exercise."""


def passed(found: str) -> Verdict:
    """
    Make the verdict on a criterion that is met.

    Parameters
    ----------
    found
        What was found, as a phrase.

    """
    return Verdict(Outcome.PASSED, found)


def failed(found: str, expected: str, advice: str) -> Verdict:
    """
    Make the verdict on a criterion that is not met.

    Parameters
    ----------
    found, expected
        What was found and what was expected, as phrases.
    advice
        What the student is to do next, as sentences.

    """
    return Verdict(Outcome.FAILED, found, expected, advice)


def unchecked(reason: str, advice: str) -> Verdict:
    """
    Make the verdict on a criterion that could not be checked.

    Parameters
    ----------
    reason
        Why not, as a phrase.
    advice
        What the student is to do next, as sentences.

    """
    return Verdict(Outcome.UNCHECKED, reason, advice=advice)


def grade(
    exercise: Exercise[SubmissionT], submission: SubmissionT
) -> Iterator[tuple[Criterion[SubmissionT], Verdict]]:
    """
    Check the criteria of an exercise one after another.

    A criterion whose needs are not met is not checked, so that one mistake is one failure.

    Parameters
    ----------
    exercise
        The exercise.
    submission
        What its checks look at.

    Yields
    ------
    Criterion, Verdict
        Each criterion, as soon as its verdict is known.

    """
    results: Results = {}
    for criterion in exercise.criteria:
        missing = [name for name in criterion.needs if not _is_passed(results[name])]
        if missing:
            verdict = unchecked(
                f"it builds on '{missing[0]}', which is not met",
                f"Correct '{missing[0]}' first, then check again.",
            )
        else:
            verdict = _check(criterion, submission)
        results[criterion.name] = verdict
        yield criterion, verdict


def _is_passed(verdict: Verdict) -> bool:
    return verdict.outcome is Outcome.PASSED


def _check(criterion: Criterion[SubmissionT], submission: SubmissionT) -> Verdict:
    """Check a criterion; what the system refuses is no mistake of the student."""
    try:
        return criterion.check(submission)
    except (OSError, RuntimeError) as error:  # rclpy's errors are RuntimeErrors
        return unchecked(
            f'the system reported: {error}',
            'Correct that (disk, memory, permissions, network), then check again.',
        )
