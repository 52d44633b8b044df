# SPDX-License-Identifier: Apache-2.0
"""Diagnostic status of the planner and the executor."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass

from humanoid_common.diagnostics import Level, PartStatus

__all__ = ['PlannerHealth', 'skills_status', 'work_status']

_REMEMBERED_S = 60.0
"""How long a failure of the model is reported as a warning."""
_LONGEST = 200


@dataclass
class PlannerHealth:
    """
    State of the planner, for diagnostics.

    Attributes
    ----------
    backend, server
        The planning backend, and the URL of the language model server; empty if there is none.
    plans
        The number of plans made.
    command
        The command being executed; empty if there is none.
    question
        The question that awaits an answer; empty if there is none.
    error, error_at_s
        The last failure of the model, and its time by the clock of `status`; empty if none.

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
            The reason, as a message.
        now_s
            The time of the failure, by the clock of `status`.

        """
        self.error, self.error_at_s = error, now_s

    def status(self, now_s: float, *, has_executor: bool) -> PartStatus:
        """
        Return the diagnostic status of the planner.

        Parameters
        ----------
        now_s
            The time of a steady clock.
        has_executor
            Whether an executor of plans is running.

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
            message = f'Planning with the rules, as the language model failed. {self.error}'
            return PartStatus('planner', message, Level.WARN, values)
        maker = 'a language model' if self.server else 'rules'
        return PartStatus('planner', f'Planning with {maker}', values=values)


def skills_status(missing: Mapping[str, str], implemented: Collection[str]) -> PartStatus:
    """
    Return the diagnostic status of the skills: which are unavailable now, and why.

    Parameters
    ----------
    missing
        The reasons, by skill name.
    implemented
        The names of the implemented skills; only these cause a warning.

    """
    lacking = sorted({*missing} & {*implemented})
    if not lacking:
        return PartStatus('skills', 'All implemented skills are available', values=missing)
    names = ', '.join(lacking)
    return PartStatus('skills', f'Not available now: {names}', Level.WARN, missing)


def work_status(command: str, step: str, failure: str) -> PartStatus:
    """
    Return the diagnostic status of the executor.

    Parameters
    ----------
    command, step
        The command and its current step, in words; empty when idle.
    failure
        The reason for the last failure; empty if there was none.

    """
    values = {'command': command[:_LONGEST] or 'none', 'last failure': failure or 'none'}
    message = f'Doing: {step or "checking the plan"}' if command else 'Waiting for a plan'
    return PartStatus('plan', message[:_LONGEST], values=values)
