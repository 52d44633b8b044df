# SPDX-License-Identifier: Apache-2.0
"""Sentences become plans, questions or refusals; nothing else does anything."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
import re
from typing import Any

from llm_planner.dialogue import Dialogue, Question, Refusal
from llm_planner.plan import MOST_STEPS, Plan, words_for
from llm_planner.rules import RulePlanner
from llm_planner.skills_file import load_skills
from llm_planner.world import in_words, KnownObject, ObjectDescription, World
import pytest
import yaml

HERE = Path(__file__).parent
SKILLS = load_skills(HERE.parent / 'config' / 'skills.yaml')
PLANNER = RulePlanner(SKILLS)
SENTENCES: dict[str, dict[str, str]] = yaml.safe_load((HERE / 'sentences.yaml').read_text())
KINDS = ('moving', 'looking', 'fetching', 'asking', 'together')
PLACES = {
    'kitchen_counter': 'kitchen', 'kitchen_table': 'kitchen', 'kitchen_bin': 'kitchen',
    'coffee_table': 'living_room', 'tv_cabinet': 'living_room', 'sideboard': 'living_room',
    'bed': 'bedroom', 'desk': 'bedroom', 'hall_shelf': 'hall',
}  # fmt: skip
RED_MUG = KnownObject('red_mug_1', 'mug', 'red', 'kitchen_counter', 'kitchen', (1.0, 3.8, 0.85))
BLUE_MUG = KnownObject('blue_mug_1', 'mug', 'blue', 'desk', 'bedroom', (3.2, 1.2, 0.77))
APPLE = KnownObject(
    'green_apple_1', 'apple', 'green', 'kitchen_table', 'kitchen', (0.0, 2.0, 0.74)
)
WORLD = World(
    PLACES, ('hall', 'kitchen', 'bedroom', 'living_room'), (RED_MUG, BLUE_MUG, APPLE),
)  # fmt: skip


def told(outcome: Any) -> str:
    """Return a plan in words, or what is said instead of one."""
    if isinstance(outcome, Plan):
        return '; '.join(words_for(step, SKILLS[step.skill]) for step in outcome.steps)
    return str(outcome.text)


def plan(text: str, world: World = WORLD, dialogue: Dialogue | None = None) -> Any:
    """Return what the planner makes of a sentence."""
    return PLANNER.plan(text, world, dialogue or Dialogue())


@pytest.mark.parametrize('text', [text for kind in KINDS for text in SENTENCES[kind]])
def test_sentences_that_are_understood(text: str) -> None:
    """Each has the plan that was written down for it."""
    expected = next(SENTENCES[kind][text] for kind in KINDS if text in SENTENCES[kind])
    assert told(plan(text)) == expected


def test_there_are_sixty_sentences() -> None:
    """In five kinds."""
    assert sum(len(SENTENCES[kind]) for kind in KINDS) >= 60


@pytest.mark.parametrize('text', SENTENCES['refused'])
def test_sentences_that_are_refused(text: str) -> None:
    """Nothing of them is done, and what was not understood is quoted."""
    outcome = plan(text)
    assert isinstance(outcome, Refusal), told(outcome)
    assert SENTENCES['refused'][text] in outcome.text


@pytest.mark.parametrize('text', SENTENCES['asked'])
def test_sentences_that_need_a_question(text: str) -> None:
    """The robot asks before it does anything."""
    outcome = plan(text)
    assert isinstance(outcome, Question), told(outcome)
    assert outcome.text == SENTENCES['asked'][text]


@pytest.mark.parametrize(
    'command, answer, expected',
    [
        ('look at the mug', 'the red one', 'look at the red mug'),
        ('look at the mug', 'blue', 'look at the blue mug'),
        ('look at the mug', 'I mean the blue one, please', 'look at the blue mug'),
        ('look at the mug', 'the second', 'look at the blue mug'),
        ('go to the table', 'the coffee table', 'go to the coffee table'),
        ('go to the table', 'kitchen', 'go to the kitchen table'),
        ('go to the kitcen', 'yes', 'go to the kitchen'),
        ('look at the mug', 'go to the hall', 'go to the hall'),
        ('look at the mug', 'stop', 'stop'),
    ],
)
def test_answers(command: str, answer: str, expected: str) -> None:
    """An answer completes the command; anything else is a new one."""
    dialogue = Dialogue()
    assert isinstance(plan(command, dialogue=dialogue), Question)
    assert told(plan(answer, dialogue=dialogue)) == expected


def test_an_answer_to_nothing_is_refused() -> None:
    """A yes, or a colour, without a question means nothing; nor does a no."""
    dialogue = Dialogue()
    assert isinstance(plan('yes', dialogue=dialogue), Refusal)
    assert isinstance(plan('go to the kitcen', dialogue=dialogue), Question)
    assert isinstance(plan('no', dialogue=dialogue), Refusal)
    assert isinstance(plan('yes', dialogue=dialogue), Refusal)


def test_a_thing_of_the_same_colour_is_asked_for_by_its_place() -> None:
    """The answer names the place; the plan then means that single thing."""
    other = replace(RED_MUG, object_id='red_mug_2', place='desk', room='bedroom')
    world = replace(WORLD, things=(RED_MUG, other))
    dialogue = Dialogue()
    question = plan('point at the mug', world, dialogue)
    assert question.text == ('Which mug: the one on the desk or the one on the kitchen counter?')
    done = plan('the one on the desk', world, dialogue)
    assert done.steps[0].arguments['target'].object_id == 'red_mug_2'


def test_it_is_what_was_spoken_of_before() -> None:
    """Also in the sentence before."""
    dialogue = Dialogue()
    plan('find the red mug', dialogue=dialogue)
    assert told(plan('look at it', dialogue=dialogue)) == 'look at the red mug'
    plan('go to the desk', dialogue=dialogue)
    assert told(plan('point at it', dialogue=dialogue)) == 'point at the red mug'


def test_what_the_robot_cannot_do_now_is_refused_with_the_reason() -> None:
    """Before anything begins, whichever step it is; nor does it walk while it may not."""
    world = replace(WORLD, missing={'pick': 'Manipulation is not running.'})
    assert plan('take the mug', world) == Refusal('Manipulation is not running.')
    assert plan('go to the kitchen and take the red mug', world) == Refusal(
        'Manipulation is not running.'
    )
    fallen = replace(WORLD, inhibition='The robot has fallen.')
    assert plan('go to the kitchen', fallen) == Refusal('The robot has fallen.')
    assert told(plan('what do you see', fallen)) == 'say what I see'


def test_the_hand_is_followed_through_the_plan() -> None:
    """Nothing is taken with a full hand; what is held is not fetched again."""
    world = replace(WORLD, holding='red mug')
    assert told(plan('bring me the red mug', world)) == 'come back to you; hand it over'
    assert 'would not be empty' in plan('take the green apple', world).text
    assert 'would not be empty' in plan('take the red mug and take the green apple').text
    assert told(plan('put it down and take the green apple', world)).startswith(
        'put it down; find'
    )


def test_it_is_what_the_hand_holds() -> None:
    """If it is to be put somewhere or brought, whatever was spoken of last."""
    for holding in ('red mug', 'something'):
        world, dialogue = replace(WORLD, holding=holding), Dialogue()
        assert 'would not be empty' in plan('take the green apple', world, dialogue=dialogue).text
        done = told(plan('put it on the desk', world, dialogue=dialogue))
        assert done == 'go to the desk; put it down at the desk'
        assert told(plan('bring it to me', world, dialogue=dialogue)) == (
            'come back to you; hand it over'
        )
        assert told(plan('look at it', world, dialogue=dialogue)) == 'look at the green apple'


def test_a_plan_of_too_many_steps_is_refused() -> None:
    """Twelve can be done at once."""
    assert len(plan(' and '.join(['turn left'] * MOST_STEPS)).steps) == MOST_STEPS
    assert 'at most 12' in plan(' and '.join(['turn left'] * (MOST_STEPS + 1))).text
    assert 'too long' in plan('go to the kitchen and ' * 40).text


@pytest.mark.parametrize(
    'text',
    ['stop', 'Stop!', 'robot stop now', 'emergency stop', 'halt', 'stop, stop, stop it'],
)
def test_stop_is_known_without_a_world(text: str) -> None:
    """Whatever else is not."""
    assert PLANNER.is_stop(text)
    assert not PLANNER.is_stop(f'{text} at the kitchen')


def test_the_same_object_is_read_again_from_its_text() -> None:
    """A description survives the way through a message."""
    described = ObjectDescription('mug', 'red', 'biggest', 'kitchen_table')
    assert PLANNER.object_of(described.text, WORLD) == described


def test_the_grammar_for_speech_has_what_can_be_said() -> None:
    """Places and classes are in it; free text is not."""
    text = PLANNER.to_jsgf(WORLD)
    assert 'kitchen counter' in text and 'red' in text and '{' not in text
    assert not any(line.startswith('<say_phrase') for line in text.splitlines())
    assert '<place>' not in PLANNER.to_jsgf(World())


def test_the_grammar_for_speech_expects_things_where_they_can_be() -> None:
    """In a container or a room, on anything else; what is typed may name any place."""
    lines = PLANNER.to_jsgf(replace(WORLD, containers=('kitchen_bin',))).splitlines()
    texts = {
        name: text.rstrip(';').split(' | ')
        for name, _, text in (line.partition(' = ') for line in lines)
    }
    assert {'bin', 'kitchen bin', 'trash', 'hall', 'bedroom'} <= {*texts['<inside>']}
    assert not {'bed', 'desk'} & {*texts['<inside>']}
    assert {'bed', 'table'} <= {*texts['<surface>']}
    assert not {'bin', 'kitchen'} & {*texts['<surface>']}
    rooms = {'hall', 'kitchen', 'bedroom', 'living room', 'lounge', 'livingroom'}
    assert {*texts['<room>']} == rooms
    assert {'bin', 'bed', 'kitchen'} <= {*texts['<place>']}
    assert isinstance(plan('put the red mug into the bed'), Plan)
    assert isinstance(plan('put the red mug on the bin'), Plan)


def test_the_grammar_for_speech_has_weights() -> None:
    """Articles are likelier than other words, and clauses have something between them."""
    text = PLANNER.to_jsgf(WORLD)
    assert '<article> = /100/ the | that' in text
    assert '(<joint> | /0.01/ <NULL>)' in text


def test_the_grammar_shows_examples() -> None:
    """Each is understood, each place is among them, and without places there are others."""
    examples = re.findall(r' \* @example (.+)', PLANNER.to_jsgf(WORLD))
    assert len(examples) > 15
    for example in examples:
        assert 'understand' not in told(PLANNER.plan(example, WORLD, Dialogue())), example
    for place in WORLD.place_names:
        assert f'go to the {in_words(place)}' in examples
    bare = re.findall(r' \* @example (.+)', PLANNER.to_jsgf(World()))
    assert 'stop' in bare and not any('room' in example for example in bare)
