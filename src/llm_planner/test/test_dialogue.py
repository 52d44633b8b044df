# SPDX-License-Identifier: Apache-2.0
"""Plans that are asked about before they are done, and answers."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from llm_planner.dialogue import (
    answer_to,
    confirmation,
    Dialogue,
    Question,
    Refusal,
    with_answers,
)
from llm_planner.grammar import tokenized
from llm_planner.plan import Plan
from llm_planner.rules import RulePlanner
from llm_planner.skills_file import load_skills
from llm_planner.world import World
import pytest

SKILLS = load_skills(Path(__file__).parents[1] / 'config' / 'skills.yaml')
PLANNER = RulePlanner(SKILLS)
WORLD = World({'desk': 'study'}, ('study', 'hall'))


def planned(command: str) -> Plan:
    """Return the plan for a command."""
    made = PLANNER.plan(command, WORLD, Dialogue())
    assert isinstance(made, Plan), made
    return made


def asked(command: str) -> Dialogue:
    """Return a dialogue in which it was asked whether a plan is to be done."""
    return Dialogue(question=confirmation(planned(command), SKILLS, 'always'))


@pytest.mark.parametrize(
    'command, is_motion',
    [
        ('go to the hall', True),
        ('wave', True),
        ('look at the desk', True),
        ('what is on the desk', True),
        ('find the red mug', True),
        ('what do you see', False),
        ('where is the red mug', False),
        ('say hello', False),
        ('wait', False),
    ],
)
def test_which_plans_are_asked_about(command: str, is_motion: bool) -> None:
    """None, those that move body, arm or head, or all."""
    plan = planned(command)
    assert confirmation(plan, SKILLS, 'never') is None
    assert (confirmation(plan, SKILLS, 'motion') is not None) == is_motion
    assert confirmation(plan, SKILLS, 'always') is not None


def test_the_plan_is_said() -> None:
    """With all of its steps."""
    question = asked('go to the hall, turn left and say done').question
    assert question is not None
    assert question.text == 'Shall I go to the hall, turn left and say "done"?'


@pytest.mark.parametrize('answer', ['yes', 'Yes, please!', 'yeah', 'do it', 'ok', 'sure'])
def test_yes(answer: str) -> None:
    """The plan that was asked about is done, not another one."""
    dialogue = asked('go to the hall')
    plan = dialogue.question.subject if dialogue.question else None
    assert PLANNER.plan(answer, WORLD, dialogue) is plan and dialogue.question is None


@pytest.mark.parametrize('answer', ['no', 'No, thank you.', 'nope', "don't do it", 'not now'])
def test_no(answer: str) -> None:
    """Nothing is done; a later yes means nothing."""
    dialogue = asked('go to the hall')
    assert PLANNER.plan(answer, WORLD, dialogue) == Refusal('All right, I will leave it.')
    assert isinstance(PLANNER.plan('yes', WORLD, dialogue), Refusal)


@pytest.mark.parametrize('command', ['go to the study', 'yes go to the study', 'maybe', 'yes no'])
def test_anything_else_is_a_new_command(command: str) -> None:
    """The plan that was asked about is forgotten."""
    dialogue = asked('go to the hall')
    outcome: Any = PLANNER.plan(command, WORLD, dialogue)
    assert isinstance(outcome, Refusal) or outcome == planned('go to the study')
    assert dialogue.question is None


def test_what_cannot_be_done_by_now_is_refused() -> None:
    """The robot has fallen between the question and the answer."""
    fallen = replace(WORLD, inhibition='The robot has fallen.')
    assert PLANNER.plan('yes', fallen, asked('go to the hall')) == Refusal('The robot has fallen.')


def test_no_is_an_answer_to_a_correction() -> None:
    """It was not meant."""
    dialogue = Dialogue()
    assert isinstance(PLANNER.plan('go to the studdy', WORLD, dialogue), Question)
    assert PLANNER.plan('no', WORLD, dialogue) == Refusal('All right, I will leave it.')


def test_a_recogniser_knows_the_answers() -> None:
    """Those for yes or no only where it is asked for them; each answers its question."""
    jsgf = 'public <command> = <go> | <stop>;\n<go> = go;\n<colour> = red | blue;\n'
    text = with_answers(jsgf, asks_to_confirm=False)
    assert text.startswith('public <command> = <answer> | <go> | <stop>;\n')
    assert text.endswith('<answer> = the (first | second | third) one | the <colour> one;\n')
    text = with_answers(jsgf, asks_to_confirm=True)
    assert text.endswith(' | yes [please] | no [thank you];\n')
    mugs = Question('Which?', 'take the mug', 'mug', {'the red one': 1, 'the blue one': 2})
    for said in ('the first one', 'the red one'):
        assert answer_to(tokenized(said), mugs) == 'the red one'
    confirm = asked('wave').question
    assert confirm is not None
    for said, meant in (('yes please', 'yes'), ('no thank you', 'no')):
        assert answer_to(tokenized(said), confirm) == meant
