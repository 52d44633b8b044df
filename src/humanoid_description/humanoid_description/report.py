# SPDX-License-Identifier: Apache-2.0
"""Show what the checks have found."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from humanoid_description.checks import Outcome

HEAD = ('check', 'found', 'result')


def report(source: str, outcomes: Sequence[Outcome]) -> str:
    """Return a table of the checks, the defects as sentences, and the verdict."""
    return '\n'.join([*_table(outcomes), '', *_sentences(source, outcomes)])


def _table(outcomes: Sequence[Outcome]) -> Iterator[str]:
    """Yield the lines of the table."""
    rows = [(outcome.title, outcome.found, outcome.result) for outcome in outcomes]
    widths = [max(map(len, column)) for column in zip(HEAD, *rows)]
    for row in (HEAD, tuple('-' * width for width in widths), *rows):
        yield '  '.join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip()


def _sentences(source: str, outcomes: Sequence[Outcome]) -> Iterator[str]:
    """Yield the defects, and how many there are."""
    defects = [defect for outcome in outcomes for defect in outcome.defects]
    skipped = sum(bool(outcome.skipped) for outcome in outcomes)
    passed = sum(not outcome.defects for outcome in outcomes) - skipped
    yield from (f'- {defect.strip()}' for defect in defects)
    counts = f'{passed} checks passed' + (f', {skipped} skipped' if skipped else '')
    verdict = f'has {_count(len(defects))}' if defects else 'is sound'
    yield f'{source} {verdict}: {counts}.'


def _count(defects: int) -> str:
    """Say how many defects there are."""
    return '1 defect' if defects == 1 else f'{defects} defects'
