# SPDX-License-Identifier: Apache-2.0
"""
Replanning after a step of a plan has failed.

Nothing is tried after a final error: a rejection, a stop, a fall, a newer command, an internal
error. At most `MOST_REPLANS` new plans are made for a command, none with steps that have already
failed, and none that moves the robot if the command was only a question.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from llm_planner.plan import check, moves, Plan, PlanError, Step, words_for
from llm_planner.skills import Skills
from llm_planner.world import listed, ObjectDescription, World

__all__ = ['MOST_REPLANS', 'Account', 'Failure', 'Remedy', 'ReplanningState', 'remedy_for']

MOST_REPLANS = 2
_CURABLE = ('FAILED', 'TIMEOUT')
_WALKING = ('go_to', 'come_back')
_WAIT_S = 5.0


@dataclass(frozen=True)
class Failure:
    """Failure of a plan: the name of an `ExecutePlan` error code, the step, and the reason."""

    code: str
    step: int
    text: str


@dataclass(frozen=True)
class Account:
    """Outcome of a command so far, in words: what was done, what failed, and why."""

    done: tuple[str, ...]
    failed: str
    because: str


@dataclass(frozen=True)
class Remedy:
    """Steps to try instead, and their announcement; without steps, only advice."""

    steps: tuple[Step, ...]
    text: str
    source: str = 'rules'


def remedy_for(steps: Sequence[Step], failed: int, skills: Skills, world: World) -> Remedy | None:
    """
    Select a remedy for a failed step with the rules.

    Parameters
    ----------
    steps, failed
        The plan, and the index of the step that failed.
    skills, world
        The skills, and the current state of the world.

    Returns
    -------
    Remedy or None
        The remaining steps, done in another way; None if nothing else makes sense.

    """
    after = failed + 1
    step, rest = steps[failed], steps[after:]
    wanted = _object_of(step, skills)
    if wanted is not None and not wanted.among(world.things, world.robot):
        return _search(steps, failed, wanted, skills, world)
    if step.skill in _WALKING:
        if 'look_around' in world.missing or 'look_around' not in skills.skills:
            before, text = (
                Step('wait', {'duration': _WAIT_S}),
                'I will wait a moment and try again.',
            )
        else:
            before, text = Step('look_around'), 'I will look around and try again.'
        return Remedy((before, step, *rest), text)
    if step.skill == 'pick':
        closer = Step('go_to', {'target': wanted})
        return Remedy((closer, step, *rest), 'I will walk up to it again and retry.')
    return None


def _search(
    steps: Sequence[Step], failed: int, wanted: ObjectDescription, skills: Skills, world: World
) -> Remedy | None:
    """Plan a search for an object that is not, or no longer, where it was expected."""
    if not any('standing' in skills[each.skill].needs for each in steps):
        return Remedy((), 'You can tell me to find it.')
    step, done = steps[failed], steps[:failed]
    anywhere = replace(wanted, place='', object_id='', is_inside=False)
    if step.skill == 'find' and anywhere == wanted:
        return None
    if wanted.object_id and anywhere.among(world.things):
        return None  # others of its kind are not the one that was meant
    again = [Step('find', {'object': anywhere})]
    has_gone = any(each.skill == 'go_to' and _object_of(each, skills) == wanted for each in done)
    if has_gone and step.skill != 'go_to':
        again.append(Step('go_to', {'target': anywhere}))
    begin = failed + (step.skill == 'find')
    left = steps[begin:]
    is_elsewhere = anywhere != wanted or any(_object_of(each, skills) == wanted for each in done)
    return Remedy(
        (*again, *(_with(each, wanted, anywhere) for each in left)),
        'I am looking for it elsewhere.' if is_elsewhere else 'I am looking for it.',
    )


def _object_of(step: Step, skills: Skills) -> ObjectDescription | None:
    """Return the single object that a step refers to."""
    for name, argument in skills[step.skill].arguments.items():
        value = step.arguments.get(name)
        if argument.kind in ('object', 'target') and isinstance(value, ObjectDescription):
            return value
    return None


def _with(step: Step, old: Any, new: Any) -> Step:
    arguments = {name: new if value == old else value for name, value in step.arguments.items()}
    return Step(step.skill, arguments)


class ReplanningState:
    """
    Replanning state of a command: what was tried, and what else may be.

    Parameters
    ----------
    plan
        The first plan.
    skills
        The available skills.

    Attributes
    ----------
    replans
        The number of new plans made.

    """

    def __init__(self, plan: Plan, skills: Skills) -> None:
        self._skills = skills
        self._plan, self._failure = plan, Failure('', -1, '')
        self._done: tuple[Step, ...] = ()
        self._tried: list[tuple[Step, ...]] = []
        self.replans = 0

    def fail(self, failure: Failure) -> None:
        """
        Record the failure of the latest plan.

        Parameters
        ----------
        failure
            The error code, the step that failed, and the reason.

        """
        self._failure = failure
        self._tried.append(self._plan.steps)
        if failure.step >= 0:
            at = failure.step
            self._done += self._plan.steps[:at]
            self._tried.append(self._plan.steps[at:])

    def may_go_on(self, world: World) -> bool:
        """
        Check whether another plan may be made after the failure.

        Parameters
        ----------
        world
            The current state of the world.

        Returns
        -------
        bool
            False after a final error or `MOST_REPLANS` new plans, and while the robot cannot walk.

        """
        return (
            self._failure.code in _CURABLE
            and 0 <= self._failure.step < len(self._plan.steps)
            and self.replans < MOST_REPLANS
            and not world.inhibition
        )

    def account(self) -> Account:
        """Summarise the outcome of the command so far."""
        [failed] = self._in_words([self._plan.steps[self._failure.step]])
        return Account(self._in_words(self._done), failed, self._failure.text)

    def by_rules(self, world: World) -> Remedy | None:
        """
        Find a remedy with the rules.

        Parameters
        ----------
        world
            The current state of the world.

        Returns
        -------
        Remedy or None
            None if the step timed out, the rules know no remedy, or it may not be executed.

        """
        if self._failure.code != 'FAILED':
            return None
        found = remedy_for(self._plan.steps, self._failure.step, self._skills, world)
        return found if found is None or self._may_be_done(found.steps, world) else None

    def by_model(self, plan: Plan, world: World) -> Remedy | None:
        """
        Build a remedy from the new plan of a language model.

        Parameters
        ----------
        plan
            The answer of the model; if it starts with all completed steps, they are left out.
        world
            The current state of the world.

        Returns
        -------
        Remedy or None
            None if the steps were tried already, may not be executed, or there are none.

        """
        steps = plan.steps
        count = len(self._done)
        if count and steps[:count] == self._done:
            steps = steps[count:]  # completed steps are not repeated
        if not steps or not self._may_be_done(steps, world):
            return None
        text = f'I will try something else: {listed(self._in_words(steps))}.'
        return Remedy(steps, text, plan.source)

    def take(self, remedy: Remedy) -> Plan:
        """
        Turn a remedy into the next plan, and count it.

        Parameters
        ----------
        remedy
            The remedy to try next; it must have steps.

        Returns
        -------
        Plan
            The plan, for the same command; `fail` and `account` refer to it from now on.

        """
        self.replans += 1
        self._plan = Plan(self._plan.command, remedy.steps, remedy.source)
        return self._plan

    def _may_be_done(self, steps: tuple[Step, ...], world: World) -> bool:
        if not steps:
            return True
        may_move = any(moves(each, self._skills) for each in (*self._tried[0], *self._done))
        if steps in self._tried:
            return False
        if not may_move and any(moves(each, self._skills) for each in steps):
            return False
        try:
            check(Plan(self._plan.command, steps), self._skills, world)
        except PlanError:
            return False
        return True

    def _in_words(self, steps: Sequence[Step]) -> tuple[str, ...]:
        return tuple(words_for(each, self._skills[each.skill]) for each in steps)
