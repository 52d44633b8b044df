# SPDX-License-Identifier: Apache-2.0
"""What is tried after a step has failed, and what is not."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from llm_planner.dialogue import Dialogue
from llm_planner.plan import Plan, Step, words_for
from llm_planner.replanning import Failure, MOST_REPLANS, remedy_for, ReplanningState
from llm_planner.rules import RulePlanner
from llm_planner.skills_file import load_skills
from llm_planner.world import KnownObject, ObjectDescription, World
import pytest

SKILLS = load_skills(Path(__file__).parents[1] / 'config' / 'skills.yaml')
PLANNER = RulePlanner(SKILLS)
MUG = KnownObject('red_mug_1', 'mug', 'red', 'desk', 'study', (3.0, 1.0, 0.75))
EMPTY = World({'desk': 'study', 'table': 'hall'}, ('hall', 'study'))
FULL = replace(EMPTY, things=(MUG,))


def planned(command: str) -> Plan:
    """Return the plan for a command."""
    made = PLANNER.plan(command, EMPTY, Dialogue())
    assert isinstance(made, Plan), made
    return made


def told(steps: Any) -> str:
    """Return steps in words."""
    return '; '.join(words_for(each, SKILLS[each.skill]) for each in steps)


@pytest.mark.parametrize(
    'command, failed, world, expected, said',
    [
        # It is not where it was thought to be.
        ('go to the red mug', 0, EMPTY,
         'find the red mug; go to the red mug', 'I am looking for it.'),
        ('go to the red mug on the desk', 0, EMPTY,
         'find the red mug; go to the red mug', 'I am looking for it elsewhere.'),
        ('find the red mug in the hall and look at it', 0, EMPTY,
         'find the red mug; look at the red mug', 'I am looking for it elsewhere.'),
        ('go to the study, find the red mug and tell me what is beside it', 2, EMPTY,
         'find the red mug; say what is beside the red mug', 'I am looking for it elsewhere.'),
        ('take the red mug and come back', 2, EMPTY,
         'find the red mug; go to the red mug; pick up the red mug; come back to you',
         'I am looking for it elsewhere.'),
        ('take the red mug from the desk', 0, EMPTY,
         'find the red mug; go to the red mug; pick up the red mug',
         'I am looking for it elsewhere.'),
        # There is no way, or no grip.
        ('turn left and go to the hall and wave', 1, EMPTY,
         'look around; go to the hall; wave', 'I will look around and try again.'),
        ('go to the hall and come back', 1, EMPTY,
         'look around; come back to you', 'I will look around and try again.'),
        ('go to the hall', 0, replace(EMPTY, missing={'look_around': 'I am blind.'}),
         'wait 5 seconds; go to the hall', 'I will wait a moment and try again.'),
        ('go to the red mug', 0, FULL,
         'look around; go to the red mug', 'I will look around and try again.'),
        ('take the red mug', 2, FULL,
         'go to the red mug; pick up the red mug', 'I will walk up to it again and retry.'),
    ],
)  # fmt: skip
def test_what_the_rules_try(
    command: str, failed: int, world: World, expected: str, said: str
) -> None:
    """What is left is done in another way; what was done is not done again."""
    found = remedy_for(planned(command).steps, failed, SKILLS, world)
    assert found is not None and told(found.steps) == expected and found.text == said


@pytest.mark.parametrize(
    'command, failed, world',
    [
        ('find the red mug', 0, EMPTY),
        ('turn left', 0, EMPTY),
        ('go to the hall and wave', 1, EMPTY),
        ('visit the hall and the study', 0, EMPTY),
        ('look around', 0, EMPTY),
    ],
)
def test_what_is_only_explained(command: str, failed: int, world: World) -> None:
    """Where nothing else makes sense, the reason is all that is said."""
    assert remedy_for(planned(command).steps, failed, SKILLS, world) is None


@pytest.mark.parametrize('command', ['where is the red mug', 'look at the red mug'])
def test_who_only_asks_sets_nothing_in_motion(command: str) -> None:
    """The robot does not leave for what it does not remember; it says what could be asked."""
    found = remedy_for(planned(command).steps, 0, SKILLS, EMPTY)
    assert found is not None and not found.steps and found.text == 'You can tell me to find it.'


def test_others_of_its_kind_are_not_the_one_that_was_chosen() -> None:
    """The mug on the desk is gone: that in the hall is another one."""
    steps = (Step('go_to', {'target': ObjectDescription('mug', object_id='red_mug_2')}),)
    assert remedy_for(steps, 0, SKILLS, FULL) is None
    found = remedy_for(steps, 0, SKILLS, EMPTY)
    assert found is not None and told(found.steps) == 'find the mug; go to the mug'


@pytest.mark.parametrize(
    'code, step, world',
    [
        ('INVALID', -1, EMPTY),
        ('UNAVAILABLE', 0, EMPTY),
        ('STOPPED', 0, EMPTY),
        ('PREEMPTED', 0, EMPTY),
        ('UNKNOWN', 0, EMPTY),
        ('FAILED', -1, EMPTY),
        ('FAILED', 7, EMPTY),
        ('FAILED', 0, replace(EMPTY, inhibition='The robot has fallen.')),
    ],
)
def test_what_is_final(code: str, step: int, world: World) -> None:
    """Nobody plans anew after a refusal, a stop, a fall or a fault."""
    recovery = ReplanningState(planned('go to the hall'), SKILLS)
    recovery.fail(Failure(code, step, 'No.'))
    assert not recovery.may_go_on(world)


def test_what_took_too_long_is_not_begun_again_by_the_rules() -> None:
    """A model may know something else."""
    recovery = ReplanningState(planned('go to the hall'), SKILLS)
    recovery.fail(Failure('TIMEOUT', 0, 'I have given up.'))
    assert recovery.may_go_on(EMPTY) and recovery.by_rules(EMPTY) is None
    assert recovery.by_model(Plan('', (Step('turn', {'direction': 'left'}),)), EMPTY) is not None


def test_the_same_is_not_tried_twice() -> None:
    """A way that failed before and after a look around is given up."""
    recovery = ReplanningState(planned('turn left and go to the hall'), SKILLS)
    recovery.fail(Failure('FAILED', 1, 'There is a wall.'))
    first = recovery.by_rules(EMPTY)
    assert first is not None
    plan = recovery.take(first)
    assert told(plan.steps) == 'look around; go to the hall' and recovery.replans == 1
    recovery.fail(Failure('FAILED', 1, 'There is a wall.'))
    assert recovery.may_go_on(EMPTY) and recovery.by_rules(EMPTY) is None


def test_two_new_plans_are_the_most() -> None:
    """Whatever fails, and however it is made."""
    recovery = ReplanningState(planned('go to the red mug'), SKILLS)
    for number in range(MOST_REPLANS):
        recovery.fail(Failure('FAILED', 0, 'No.'))
        assert recovery.may_go_on(EMPTY)
        steps = (Step('wait', {'duration': number + 1.0}), Step('look_around'))
        found = recovery.by_model(Plan('', steps), EMPTY)
        assert found is not None
        recovery.take(found)
    recovery.fail(Failure('FAILED', 0, 'No.'))
    assert not recovery.may_go_on(EMPTY)


def test_what_a_model_plans_anew_is_checked() -> None:
    """It repeats neither what was done nor what failed, and may not do more than others."""
    recovery = ReplanningState(planned('turn left and go to the hall and wave'), SKILLS)
    recovery.fail(Failure('FAILED', 1, 'There is a "wall".'))
    account = recovery.account()
    assert account.done == ('turn left',) and account.failed == 'go to the hall'
    assert account.because == 'There is a "wall".'
    turn, hall, study, wave = (
        planned(each).steps[0]
        for each in ('turn left', 'go to the hall', 'go to the study', 'wave')
    )

    def accepted(*steps: Step) -> str | None:
        found = recovery.by_model(Plan('', steps, 'openai'), EMPTY)
        return None if found is None else told(found.steps)

    assert accepted(turn, hall, wave) is None
    assert accepted(hall, wave) is None
    assert accepted() is None and accepted(turn) is None
    assert accepted(Step('go_to', {'target': 'moon'})) is None
    assert accepted(turn, study, hall, wave) == 'go to the study; go to the hall; wave'
    found = recovery.by_model(Plan('', (study, wave), 'openai'), EMPTY)
    assert found is not None
    assert found.text == 'I will try something else: go to the study and wave.'
    assert recovery.take(found) == Plan(
        'turn left and go to the hall and wave', (study, wave), 'openai'
    )


def test_a_model_does_not_move_the_robot_for_a_question() -> None:
    """Neither does it when the first plan has failed."""
    recovery = ReplanningState(planned('where is the red mug'), SKILLS)
    recovery.fail(Failure('FAILED', 0, 'I do not remember the red mug.'))
    steps = planned('find the red mug and tell me where it is').steps
    assert recovery.by_model(Plan('', steps), EMPTY) is None
    assert recovery.by_model(Plan('', (Step('say', {'text': 'No idea.'}),)), EMPTY) is not None
