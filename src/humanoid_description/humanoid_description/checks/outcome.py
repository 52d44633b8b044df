# SPDX-License-Identifier: Apache-2.0
"""Checks, their outcomes, and the report of these."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby

from humanoid_description.robot import Robot

HEAD = ('check', 'found', 'result')


def count(number: int, noun: str) -> str:
    """
    Format a number with its noun, such as '1 link' or '2 links'.

    Parameters
    ----------
    number
        How many there are.
    noun
        The singular, whose plural has an s.

    """
    return f'{number} {noun}' + ('' if number == 1 else 's')


@dataclass(frozen=True)
class Outcome:
    """The value that a check found, messages on the defects, and why it was skipped, if so."""

    title: str
    found: str = ''
    defects: tuple[str, ...] = ()
    skipped: str = ''

    @property
    def result(self) -> str:
        """Return the outcome in a word or two."""
        if self.skipped:
            return f'skipped: {self.skipped}'
        return count(len(self.defects), 'defect') if self.defects else 'ok'


@dataclass(frozen=True)
class Check:
    """A check of a robot: returns the value for the report, and a message for each defect."""

    title: str
    look: Callable[[Robot], tuple[str, Iterable[str]]]

    def __call__(self, robot: Robot) -> Outcome:
        """Run the check."""
        found, defects = self.look(robot)
        return Outcome(self.title, found, tuple(defects))

    def skip(self, why: str) -> Outcome:
        """
        Skip the check.

        Parameters
        ----------
        why
            The reason that the report gives.

        Returns
        -------
        Outcome
            The outcome of a skipped check.

        """
        return Outcome(self.title, skipped=why)


def report(source: str, outcomes: Sequence[Outcome]) -> str:
    """
    Format the outcomes of checks: a table, the defects as messages, and the verdict.

    Parameters
    ----------
    source
        The name of the checked model, for the verdict.
    outcomes
        The outcomes of the checks, in the order of the table.

    """
    return '\n'.join([*_table(outcomes), '', *_sentences(source, outcomes)])


def _table(outcomes: Sequence[Outcome]) -> Iterator[str]:
    """Yield the lines of the table."""
    rows = list(_rows(outcomes))
    widths = [max(map(len, column)) for column in zip(HEAD, *rows)]
    for row in (HEAD, tuple('-' * width for width in widths), *rows):
        yield '  '.join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip()


def _rows(outcomes: Sequence[Outcome]) -> Iterator[tuple[str, str, str]]:
    """Yield the cells of one row per check, but one row for checks skipped for the same reason."""
    for obstacle, group in groupby(outcomes, key=lambda outcome: outcome.skipped):
        checks = list(group)
        if obstacle and len(checks) > 1:
            yield f'{len(checks)} more', '', checks[0].result
        else:
            yield from ((check.title, check.found, check.result) for check in checks)


def _sentences(source: str, outcomes: Sequence[Outcome]) -> Iterator[str]:
    """Yield the defects, and the verdict."""
    defects = [defect for outcome in outcomes for defect in outcome.defects]
    skipped = sum(bool(outcome.skipped) for outcome in outcomes)
    passed = sum(not outcome.defects for outcome in outcomes) - skipped
    yield from (f'- {defect.strip()}' for defect in defects)
    counts = f'{count(passed, "check")} passed' + (f', {skipped} skipped' if skipped else '')
    verdict = f'has {count(len(defects), "defect")}' if defects else 'is sound'
    yield f'{source} {verdict}: {counts}.'
