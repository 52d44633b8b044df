# SPDX-License-Identifier: Apache-2.0
"""
The behaviour tree that does a plan: one step after another, each watched, timed and tried again.

A skill is a generator: it yields once a tick while it waits, returns when it has succeeded, and
raises SkillError when it has not. Closing it undoes what goes on, such as a goal that was sent.
"""

from __future__ import annotations

from collections.abc import Callable, Generator
from dataclasses import dataclass

from llm_planner.plan import Plan, Step, words_for
from llm_planner.skills import Skill, Skills
import py_trees
from py_trees.behaviour import Behaviour
from py_trees.common import ParallelPolicy, Status

__all__ = ['Progress', 'SkillError', 'SkillRun', 'StepNews', 'make_tree']

SkillRun = Generator[None, None, None]
Start = Callable[[Step], SkillRun]


class SkillError(Exception):
    """
    A skill has failed; the text says why, to the person who asked.

    Attributes
    ----------
    code
        The name of a code of `ExecutePlan`'s result.
    is_final
        Whether it makes no sense to try again.

    """

    def __init__(self, text: str, code: str = 'FAILED', *, is_final: bool = False) -> None:
        super().__init__(text)
        self.code, self.is_final = code, is_final


@dataclass(frozen=True)
class StepNews:
    """What happens to a step: its index, a state of `ExecutePlan`'s feedback, and words."""

    index: int
    state: str
    text: str


@dataclass
class Progress:
    """How far a plan is, and why it does not go on."""

    tell: Callable[[StepNews], None] = lambda _: None
    index: int = -1
    """Of the step that runs, or ran last."""
    error: SkillError | None = None


class _SkillBehaviour(Behaviour):
    """Runs one attempt of a skill."""

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
        """Begin an attempt."""
        self._progress.error = None
        self._end_s = self._now_s() + self._skill.timeout_s
        self._run = self._start(self._step)

    def update(self) -> Status:
        """Go on with it until it waits again."""
        assert self._run is not None
        # A simulation that begins anew sets the time back.
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
        """Undo what goes on."""
        run, self._run = self._run, None
        if run is not None:
            run.close()

    def _fail(self, error: SkillError) -> Status:
        self._progress.error = error
        return Status.FAILURE


class _Retry(py_trees.decorators.Decorator):
    """Tries a skill again unless that makes no sense."""

    def __init__(self, child: Behaviour, attempts: int, progress: Progress) -> None:
        super().__init__(f'up to {attempts} times', child)
        self._attempts, self._progress, self._failures = attempts, progress, 0

    def initialise(self) -> None:
        """Count anew."""
        self._failures = 0

    def update(self) -> Status:
        """Let the child be ticked again after a failure that may be overcome."""
        status: Status = self.decorated.status
        if status != Status.FAILURE:
            return status
        self._failures += 1
        error = self._progress.error
        if self._failures >= self._attempts or (error is not None and error.is_final):
            return Status.FAILURE
        return Status.RUNNING


class _Condition(Behaviour):
    """Fails as soon as something hinders the step."""

    def __init__(self, inhibition: Callable[[], str], progress: Progress) -> None:
        super().__init__('nothing hinders')
        self._inhibition, self._progress = inhibition, progress

    def update(self) -> Status:
        """Look."""
        reason = self._inhibition()
        if not reason:
            return Status.RUNNING
        self._progress.error = SkillError(reason, 'UNAVAILABLE', is_final=True)
        return Status.FAILURE


class _Told(py_trees.decorators.Decorator):
    """Tells how a step begins and ends."""

    def __init__(self, child: Behaviour, index: int, text: str, progress: Progress) -> None:
        super().__init__(f'step {index}', child)
        self._index, self._text, self._progress = index, text, progress

    def initialise(self) -> None:
        """Tell that it begins."""
        self._progress.index = self._index
        self._progress.tell(StepNews(self._index, 'running', self._text))

    def update(self) -> Status:
        """Tell how it ended."""
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
    Return the tree that does a plan when it is ticked; `stop(Status.INVALID)` breaks it off.

    Parameters
    ----------
    plan, skills
        What to do. It was checked before.
    start
        Begins an attempt of a step.
    inhibition
        Returns why the robot cannot walk now; nothing if it can. It ends a skill that needs
        `standing`.
    now_s
        Returns the time in s.
    progress
        Is kept up to date.

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
