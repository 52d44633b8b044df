# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 bag recover`."""

from __future__ import annotations

import argparse
import sys
import time

from ros2bag.verb import VerbExtension

TYPE_CHECKING = False

if TYPE_CHECKING:
    from ros2bag.storage.recovery import RecoveredFile  # noqa: I300

PERIOD_S = 2.0


class RecoverVerb(VerbExtension):
    """Make a broken or unfinished bag readable."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the folder of the bag.

        Parameters
        ----------
        parser, cli_name
            As for `VerbExtension.add_arguments`.

        """
        parser.add_argument(
            'bag_path', help='the folder of the bag; broken files are kept under another name'
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Salvage the messages of broken files, and rewrite `metadata.yaml`.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments, as for `VerbExtension.main`.

        Raises
        ------
        BagError
            The folder is not that of a bag, the bag is still being recorded, or it cannot be
            written.

        """
        _recover_and_report(args.bag_path)
        return None


def _recover_and_report(folder: str) -> None:
    """Recover a bag, and print progress and the outcome of each file."""
    from ros2bag.storage.recovery import recover

    outcomes = recover(folder, _Progress())
    for each in outcomes:
        if each.objection:
            print(f'{each.path}: skipped {each.objection}', file=sys.stderr)
        print(_outcome_text(each))
    total = sum(each.message_count for each in outcomes)
    print(f'{folder}: {total} messages; metadata.yaml is written')


def _outcome_text(outcome: RecoveredFile) -> str:
    if not outcome.was_broken:
        return f'{outcome.path}: intact, {outcome.message_count} messages'
    if outcome.damaged_parts:
        damage, advice = f', {outcome.damaged_parts} damaged parts skipped', ''
    else:
        damage, advice = '', ', which can be deleted'
    return (
        f'{outcome.path}: recovered {outcome.message_count} messages{damage}; the original '
        f'is kept as {outcome.kept_path}{advice}'
    )


class _Progress:
    """Periodic progress report."""

    def __init__(self) -> None:
        self._next_s = time.monotonic() + PERIOD_S

    def __call__(self, path: str, share: float) -> None:
        if time.monotonic() >= self._next_s:
            self._next_s = time.monotonic() + PERIOD_S
            print(f'{path}: {share:.0%} read', file=sys.stderr)
