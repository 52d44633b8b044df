# SPDX-License-Identifier: Apache-2.0
"""Output of `ros2 bag recover`."""

from __future__ import annotations

import sys
import time

from ros2bag.storage.recovery import recover, RecoveredFile

__all__ = ['recover_and_report']

PERIOD_S = 2.0


def recover_and_report(folder: str) -> None:
    """
    Recover a bag, and print progress and the outcome of each file.

    Parameters
    ----------
    folder
        The folder of the bag.

    Raises
    ------
    BagError
        The folder is not that of a bag, the bag is still being recorded, or it cannot be written.

    """
    outcomes = recover(folder, _Progress())
    for each in outcomes:
        if each.objection:
            print(f'{each.path}: left out {each.objection}', file=sys.stderr)
        print(_outcome_text(each))
    total = sum(each.message_count for each in outcomes)
    print(f'{folder}: {total} messages; metadata.yaml is written')


def _outcome_text(outcome: RecoveredFile) -> str:
    if not outcome.was_broken:
        return f'{outcome.path}: whole, {outcome.message_count} messages'
    if outcome.damaged_parts:
        damage, advice = f', {outcome.damaged_parts} damaged parts left out', ''
    else:
        damage, advice = '', ', which can be deleted'
    return (
        f'{outcome.path}: recovered {outcome.message_count} messages{damage}; what it was is '
        f'in {outcome.kept_path}{advice}'
    )


class _Progress:
    """Periodic progress report."""

    def __init__(self) -> None:
        self._next_s = time.monotonic() + PERIOD_S

    def __call__(self, path: str, share: float) -> None:
        if time.monotonic() >= self._next_s:
            self._next_s = time.monotonic() + PERIOD_S
            print(f'{path}: {share:.0%} read', file=sys.stderr)
