# SPDX-License-Identifier: Apache-2.0
"""Checks and their outcomes."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from humanoid_description.robot import Robot


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
