# SPDX-License-Identifier: Apache-2.0
"""How planner and executor are, for diagnostics."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass

from humanoid_common.diagnostics import Level, PartStatus

__all__ = ['PlannerHealth', 'skills_status', 'work_status']

_REMEMBERED_S = 60.0
"""How long a failure of the model is a warning."""
_LONGEST = 200


@dataclass
class PlannerHealth:
    """
    What is to be said of a planner.

    Attributes
    ----------
    backend, server
        What makes plans, and where a language model is asked; empty if none is.
    plans
        How many were made.
    command
        What is being done; empty if nothing is.
    question
        The question that waits for an answer; empty if none does.
    error, error_at_s
        How the model failed last, and when, by the clock of `status`; empty if it did not.

    """

    backend: str
    server: str = ''
    plans: int = 0
    command: str = ''
    question: str = ''
    error: str = ''
    error_at_s: float = 0.0

    def fail(self, error: str, now_s: float) -> None:
        """
        Record a failure of the language model, after which the rules plan instead.

        Parameters
        ----------
        error
            Why it failed, as a sentence.
        now_s
            When it failed, by the clock of `status`.

        """
        self.error, self.error_at_s = error, now_s

    def status(self, now_s: float, *, has_executor: bool) -> PartStatus:
        """
        Return how the planner is.

        Parameters
        ----------
        now_s
            The time, by a clock that nobody stops.
        has_executor
            Whether something runs that does plans.

        """
        values = {
            'backend': self.backend,
            'plans': self.plans,
            'doing': self.command[:_LONGEST] or 'nothing',
        }
        if self.server:
            values |= {'server': self.server, 'last error of the model': self.error or 'none'}
        if self.question:
            values['waits for an answer to'] = self.question[:_LONGEST]
        if not has_executor:
            message = 'The skill executor is not running: nothing can be done.'
            return PartStatus('planner', message, Level.WARN, values)
        if self.error and now_s - self.error_at_s < _REMEMBERED_S:
            message = f'The rules plan, as the language model failed. {self.error}'
            return PartStatus('planner', message, Level.WARN, values)
        maker = 'a language model' if self.server else 'rules'
        return PartStatus('planner', f'Plans by {maker}', values=values)


def skills_status(missing: Mapping[str, str], implemented: Collection[str]) -> PartStatus:
    """
    Return which skills cannot be used now, and why.

    Parameters
    ----------
    missing
        The reasons, by the names of skills.
    implemented
        The names of skills that can be done once their servers run; the others are no trouble.

    """
    lacking = sorted({*missing} & {*implemented})
    if not lacking:
        return PartStatus('skills', 'All that can be done is available', values=missing)
    names = ', '.join(lacking)
    return PartStatus('skills', f'Not available now: {names}', Level.WARN, missing)


def work_status(command: str, step: str, failure: str) -> PartStatus:
    """
    Return what an executor does.

    Parameters
    ----------
    command, step
        What it was asked for, and what it is at, in words; empty if nothing is done.
    failure
        Why the last plan failed; empty if it did not.

    """
    values = {'command': command[:_LONGEST] or 'none', 'last failure': failure or 'none'}
    message = f'Doing: {step or "looks at the plan"}' if command else 'Waits for a plan'
    return PartStatus('plan', message[:_LONGEST], values=values)
