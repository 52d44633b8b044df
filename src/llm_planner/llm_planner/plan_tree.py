# SPDX-License-Identifier: Apache-2.0
"""
Behaviour tree that executes a plan: steps in sequence, with guards, timeouts and retries.

Its leaves advance the generator of a skill once per tick: see `skills.SkillRun`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from llm_planner.plan import Plan, Step, words_for
from llm_planner.skills import Skill, SkillError, SkillRun, Skills
import py_trees
from py_trees.behaviour import Behaviour
from py_trees.common import ParallelPolicy, Status

__all__ = ['Progress', 'StepNews', 'make_tree']

Start = Callable[[Step], SkillRun]


@dataclass(frozen=True)
class StepNews:
    """A change of a step: its index, a state of the `ExecutePlan` feedback, and a message."""

    index: int
    state: str
    text: str


@dataclass
class Progress:
    """The progress of a plan, and its latest error."""

    tell: Callable[[StepNews], None] = lambda _: None
    index: int = -1
    """The index of the running step, or of the last one that ran."""
    error: SkillError | None = None


class _SkillBehaviour(Behaviour):
    """Behaviour that runs one attempt of a skill."""

    def __init__(
        self,
        step: Step,
        skill: Skill,
        start: Start,
        now_s: Callable[[], float],
        progress: Progress,
    ) -> None:
        super().__init__(skill.name)
        self._step, self._skill, self._start = step, skill, start
        self._now_s, self._progress = now_s, progress
        self._run: SkillRun | None = None
        self._end_s = 0.0

    def initialise(self) -> None:
        """Start an attempt."""
        self._progress.error = None
        self._end_s = self._now_s() + self._skill.timeout_s
        self._run = self._start(self._step)

    def update(self) -> Status:
        """Advance the skill by one tick."""
        assert self._run is not None
        # A restart of the simulation sets the clock back.
        self._end_s = min(self._end_s, self._now_s() + self._skill.timeout_s)
        if self._now_s() >= self._end_s:
            return self._fail(
                SkillError(
                    f'I have given up: it took me longer than {self._skill.timeout_s:.0f} seconds '
                    f'to {words_for(self._step, self._skill)}.',
                    'TIMEOUT',
                    is_final=True,
                )
            )
        try:
            next(self._run)
        except StopIteration:
            return Status.SUCCESS
        except SkillError as error:
            return self._fail(error)
        return Status.RUNNING

    def terminate(self, new_status: Status) -> None:
        """Cancel the running skill."""
        run, self._run = self._run, None
        if run is not None:
            run.close()

    def _fail(self, error: SkillError) -> Status:
        self._progress.error = error
        return Status.FAILURE


class _Retry(py_trees.decorators.Decorator):
    """Decorator that retries a skill unless its error is final."""

    def __init__(self, child: Behaviour, attempts: int, progress: Progress) -> None:
        super().__init__(f'up to {attempts} times', child)
        self._attempts, self._progress, self._failures = attempts, progress, 0

    def initialise(self) -> None:
        """Reset the failure count."""
        self._failures = 0

    def update(self) -> Status:
        """Stay running, to retry, after a failure that is not final."""
        status: Status = self.decorated.status
        if status != Status.FAILURE:
            return status
        self._failures += 1
        error = self._progress.error
        if self._failures >= self._attempts or (error is not None and error.is_final):
            return Status.FAILURE
        return Status.RUNNING


class _Condition(Behaviour):
    """Guard that fails as soon as the step is inhibited."""

    def __init__(self, inhibition: Callable[[], str], progress: Progress) -> None:
        super().__init__('not inhibited')
        self._inhibition, self._progress = inhibition, progress

    def update(self) -> Status:
        """Check the inhibition."""
        reason = self._inhibition()
        if not reason:
            return Status.RUNNING
        self._progress.error = SkillError(reason, 'UNAVAILABLE', is_final=True)
        return Status.FAILURE


class _Told(py_trees.decorators.Decorator):
    """Decorator that reports the start and the result of a step."""

    def __init__(self, child: Behaviour, index: int, text: str, progress: Progress) -> None:
        super().__init__(f'step {index}', child)
        self._index, self._text, self._progress = index, text, progress

    def initialise(self) -> None:
        """Report the start."""
        self._progress.index = self._index
        self._progress.tell(StepNews(self._index, 'running', self._text))

    def update(self) -> Status:
        """Report the result."""
        status: Status = self.decorated.status
        if status == Status.SUCCESS:
            self._progress.tell(StepNews(self._index, 'succeeded', self._text))
        elif status == Status.FAILURE:
            error = self._progress.error
            self._progress.tell(StepNews(self._index, 'failed', str(error or self._text)))
        return status


def make_tree(
    plan: Plan,
    skills: Skills,
    start: Start,
    inhibition: Callable[[], str],
    now_s: Callable[[], float],
    progress: Progress,
) -> Behaviour:
    """
    Build the behaviour tree that executes a plan; `stop(Status.INVALID)` aborts it.

    Parameters
    ----------
    plan, skills
        The validated plan, and the skills.
    start
        Starts an attempt of a step.
    inhibition
        Returns why the robot cannot walk now; empty if it can. An inhibition aborts a skill that
        needs `standing`.
    now_s
        Returns the time in s.
    progress
        The progress; the tree updates it.

    """
    steps: list[Behaviour] = []
    for index, step in enumerate(plan.steps):
        skill = skills[step.skill]
        attempt = _SkillBehaviour(step, skill, start, now_s, progress)
        work: Behaviour = _Retry(attempt, skill.attempts, progress)
        if 'standing' in skill.needs:
            condition = _Condition(inhibition, progress)
            policy = ParallelPolicy.SuccessOnSelected([work], synchronise=False)
            work = py_trees.composites.Parallel(skill.name, policy, [condition, work])
        steps.append(_Told(work, index, words_for(step, skill), progress))
    root: Behaviour = py_trees.composites.Sequence(plan.command[:40], True, steps)
    return root
