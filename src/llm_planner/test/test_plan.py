# SPDX-License-Identifier: Apache-2.0
"""What no plan may do, whoever made it; and plans as messages."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from diagnostic_msgs.msg import KeyValue
from humanoid_interfaces.msg import Plan as PlanMessage
from humanoid_interfaces.msg import PlanStep
from llm_planner.dialogue import Dialogue
from llm_planner.plan import check, Plan, PlanError, Step, UnavailableError
from llm_planner.plan_messages import plan_message, plan_of
from llm_planner.rules import RulePlanner
from llm_planner.skills_file import load_skills
from llm_planner.world import KnownObject, ObjectDescription, World
import pytest

SKILLS = load_skills(Path(__file__).parents[1] / 'config' / 'skills.yaml')
PLANNER = RulePlanner(SKILLS)
MUG = KnownObject('red_mug_1', 'mug', 'red', 'desk', 'study')
WORLD = World({'desk': 'study'}, ('study', 'hall'), (MUG,))

FORBIDDEN: list[tuple[str, dict[str, Any], str]] = [
    ('rm', {}, "no skill 'rm'"),
    ('bring', {'object': ObjectDescription('mug')}, "no skill 'bring'"),
    ('go_to', {'target': '/etc/passwd'}, 'not know a place called'),
    ('go_to', {'target': 'hall; rm -rf /'}, 'not know a place called'),
    ('go_to', {'target': 'Study'}, 'not know a place called'),
    ('go_to', {'target': 3.0}, 'has to be a string'),
    ('go_to', {'target': ObjectDescription('mug', place='moon')}, 'not know a place called'),
    ('go_to', {'target': ObjectDescription(object_id='red_mug_9')}, 'anything called'),
    ('find', {'object': ObjectDescription('gun')}, "Unknown class 'gun'"),
    ('find', {'object': ObjectDescription('mug', 'rad')}, "Did you mean 'red'?"),
    ('find', {'object': ObjectDescription('mug', '', 'cursed')}, "Unknown which 'cursed'"),
    ('go_to', {}, "needs 'target'"),
    ('go_to', {'target': 'hall', 'speed': 99.0}, "has no argument 'speed'"),
    ('go_to', {'target': 'x' * 10_000}, 'x...'),
    ('move', {'distance': 500.0}, 'out of my range'),
    ('move', {'distance': -1.0}, 'out of my range'),
    ('move', {'distance': float('nan')}, 'out of my range'),
    ('move', {'distance': float('inf')}, 'out of my range'),
    ('move', {'distance': True}, 'has to be a number'),
    ('move', {'distance': '1'}, 'has to be a number'),
    ('move', {'direction': 'up'}, 'one of forward, backward'),
    ('move', {'direction': ['forward']}, 'one of forward, backward'),
    ('go_to', {'target': ['hall']}, 'has to be a string'),
    ('wait', {'duration': 1e9}, 'out of my range'),
    ('wait', {'duration': ObjectDescription('mug')}, 'not an object'),
    ('turn', {'direction': 'left', 'angle': 4000.0}, 'out of my range'),
    ('find', {'object': 'the mug'}, 'has to be an object'),
    ('say', {'text': 'a' * 301}, 'longer than 300'),
    ('say', {'text': None}, "needs 'text'"),
    ('follow_path', {'places': ()}, 'list of places'),
    ('follow_path', {'places': ('hall', 'moon')}, 'not know a place called'),
    ('place', {}, 'not be holding anything'),
    ('hand_over', {}, 'not be holding anything'),
]


@pytest.mark.parametrize('skill, arguments, said', FORBIDDEN)
def test_steps_that_are_refused(skill: str, arguments: dict[str, Any], said: str) -> None:
    """Whatever comes from outside is checked before anything begins."""
    plan = Plan('?', (Step('turn', {'direction': 'left'}), Step(skill, arguments)))
    with pytest.raises(PlanError) as caught:
        check(plan, SKILLS, WORLD)
    assert said in str(caught.value) and len(str(caught.value)) < 400


def test_plans_that_are_refused() -> None:
    """None of no steps, none of too many, and none that the robot cannot do now."""
    turn = Step('turn', {'direction': 'left'})
    for steps, said in (((), 'nothing to do'), ((turn,) * 13, '13 steps')):
        with pytest.raises(PlanError, match=said):
            check(Plan('?', steps), SKILLS, WORLD)
    check(Plan('?', (turn,) * 12), SKILLS, WORLD)
    with pytest.raises(UnavailableError, match='No legs'):
        check(Plan('?', (turn,)), SKILLS, replace(WORLD, missing={'turn': 'No legs.'}))
    with pytest.raises(PlanError, match='I do not know any places'):
        check(Plan('?', (Step('go_to', {'target': 'hall'}),)), SKILLS, World())


def test_messages_are_read_as_they_were_written() -> None:
    """Whatever the arguments are."""
    steps = (
        Step('go_to', {'target': 'desk'}),
        Step('go_to', {'target': ObjectDescription('mug', 'red', 'biggest', 'desk')}),
        Step('find', {'object': ObjectDescription('apple', is_definite=False)}),
        Step('look_at', {'target': ObjectDescription('mug', 'red', object_id='red_mug_1')}),
        Step('move', {'direction': 'backward', 'distance': 0.5}),
        Step('follow_path', {'places': ('hall', 'study')}),
        Step('say', {'text': 'a, b'}),
        Step('describe', {}),
    )
    plan = Plan('words', steps, 'rules')
    message = plan_message(plan, PLANNER)
    assert message.steps[1].text == 'go to the biggest red mug on the desk'
    assert plan_of(message, PLANNER, WORLD) == plan


@pytest.mark.parametrize(
    'skill, key, value, said',
    [
        ('move', 'distance', 'far', "is 'far', which is not a number"),
        ('find', 'object', 'a spaceship', 'I do not know what'),
        ('find', 'object', 'it', 'I do not know what'),
        ('go_to', 'target', 'the moon', 'I do not know what'),
    ],
)
def test_messages_that_cannot_be_read(skill: str, key: str, value: str, said: str) -> None:
    """A sentence says which argument."""
    step = PlanStep(skill=skill, arguments=[KeyValue(key=key, value=value)])
    with pytest.raises(PlanError, match=said):
        plan_of(PlanMessage(steps=[step]), PLANNER, WORLD)


WISHES = (Path(__file__).parent / 'wishes.txt').read_text().splitlines()


@pytest.mark.parametrize('text', [line for line in WISHES if line and line[0] != '#'])
def test_injections_and_absurd_wishes_move_nothing(text: str) -> None:
    """None of them becomes a plan that moves the robot."""
    outcome = PLANNER.plan(text, WORLD, Dialogue())
    steps = outcome.steps if isinstance(outcome, Plan) else ()
    assert {each.skill for each in steps} <= {'say'}, steps


def test_there_are_sixty_wishes() -> None:
    """As many as were asked for."""
    assert sum(bool(line) and line[0] != '#' for line in WISHES) >= 60
