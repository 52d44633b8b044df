# SPDX-License-Identifier: Apache-2.0
"""Language models that plan well, badly, or not at all."""

from __future__ import annotations

from collections.abc import Iterator
import json
from pathlib import Path
import threading
import time
from typing import Any

from llm_planner.dialogue import Refusal
from llm_planner.model_planner import ModelError, ModelPlanner, plan_schema
from llm_planner.model_server import ModelServer
from llm_planner.model_testing import Answer, GOOD, ModelStub, says, serving
from llm_planner.plan import MOST_STEPS, Plan, words_for
from llm_planner.skills_file import load_skills
from llm_planner.world import KnownObject, World
import pytest

SKILLS = load_skills(Path(__file__).parents[1] / 'config' / 'skills.yaml')
MUG = KnownObject('red_mug_1', 'mug', 'red', 'desk', 'study')
WORLD = World(
    {'desk': 'study'}, ('study', 'hall'), (MUG,), {'pick': 'Manipulation is not running.'}
)
KEY = 'sk-very-secret'


def step(skill: str, **arguments: Any) -> dict[str, Any]:
    """Return a step as a model writes it."""
    return {'skill': skill, 'arguments': arguments}


def asked(stub: ModelStub, timeout_s: float = 60.0, **options: Any) -> Any:
    """Return what becomes of a wish."""
    server = ModelServer(stub.url, key=KEY, **options)
    return ModelPlanner(SKILLS, server.answer, timeout_s).plan('go to the hall', WORLD)


def told(outcome: Any) -> str:
    """Return a plan in words."""
    assert isinstance(outcome, Plan), outcome
    return '; '.join(words_for(each, SKILLS[each.skill]) for each in outcome.steps)


def takes_no_schema(request: dict[str, Any]) -> Answer:
    """Answer as a server that knows only JSON objects."""
    if request.get('response_format', {}).get('type') == 'json_schema':
        return 400, {'error': {'message': "'response_format' json_schema is not supported"}}
    return says(GOOD)


def takes_no_format(request: dict[str, Any]) -> Answer:
    """Answer as a server that knows no formats."""
    if 'response_format' in request:
        return 400, {'error': {'message': 'unknown field response_format'}}
    return says('Sure! ' + json.dumps(GOOD) + ' Have fun.')


@pytest.mark.parametrize(
    'answers',
    [
        [says(GOOD)],
        [says('```json\n' + json.dumps(GOOD, indent=2) + '\n```')],
        [says('<think>Where is {"steps": []}?</think>' + json.dumps(GOOD))],
        [says('Of course: {"note": 1} ' + json.dumps(GOOD) + ' I hope that helps {')],
        [takes_no_schema],
        [takes_no_format],
        [says('I would go there.'), says(GOOD)],
        [says({'steps': [step('fly')]}), says({'steps': [step('swim')]}), says(GOOD)],
        [says({**GOOD, 'extra': 1})],
    ],
)
def test_answers_that_can_be_used(answers: list[Any]) -> None:
    """A good plan comes of them, if need be after the model has been told what was wrong."""
    with serving(ModelStub(*answers)) as stub:
        assert told(asked(stub)) == 'go to the hall'


def hangs(over: threading.Event) -> Iterator[bytes]:
    """Send nothing."""
    over.wait(30.0)
    yield b''


def trickles(over: threading.Event) -> Iterator[bytes]:
    """Send a little again and again."""
    while not over.wait(0.05):
        yield b' '


def floods(over: threading.Event) -> Iterator[bytes]:
    """Send without an end."""
    while not over.is_set():
        yield b'x' * 65536


BAD: list[tuple[list[Any], str]] = [
    ([(500, 'oops')], 'failed with status 500'),
    ([(503, '')], 'failed with status 503'),
    ([(302, '')], 'failed with status 302'),
    ([(429, {'error': 'slow down'})], 'too many requests'),
    ([(401, {'error': f'bad key {KEY}'})], 'does not accept the key'),
    ([(404, {'error': 'no such model'})], "has no model 'small-model'. It has: small-model"),
    ([(400, {'error': 'The model gpt-4 is retired'})], 'It has: small-model'),
    ([(400, {'error': {'message': 'Model Not Exist'}})], 'It has: small-model'),
    ([(400, {'error': {'message': 'x/y is not a valid model ID'}})], 'It has: small-model'),
    ([(400, {'error': {'code': 'model_not_found'}})], 'It has: small-model'),
    ([(400, {'error': "This model's context length is 512 tokens"})], 'with status 400'),
    ([(400, {'error': 'The model does not support max_tokens'})], 'with status 400'),
    ([(200, '<html>Sign in</html>')], 'not a chat completion'),
    ([(200, '')], 'not a chat completion'),
    ([(200, {'choices': []})], 'not a chat completion'),
    ([(200, '[' * 100_000)], 'not a chat completion'),
    ([says('')], 'is empty'),
    ([(200, {'choices': [{'message': {'content': None, 'refusal': 'I must not.'}}]})], 'must not'),
    ([says('Just go there.')], 'no JSON object'),
    ([says(json.dumps(GOOD)[:-20])], 'no JSON object'),
    ([says('{"steps": ' * 5000)], 'no JSON object'),
    ([says({'steps': 'all'})], 'no list'),
    ([says({'steps': [3]})], 'no "skill"'),
    ([says({'steps': []})], 'nothing to do'),
    ([says({'steps': [step('rm', path='/')]})], "no skill 'rm'"),
    ([says({'steps': [step('bring', object={'class': 'mug'})]})], "no skill 'bring'"),
    ([says({'steps': [step('move', direction='forward', distance=500)]})], 'out of my range'),
    ([says('{"steps": [{"skill": "wait", "arguments": {"duration": NaN}}]}')], 'out of my range'),
    ([says({'steps': [step('go_to', target='moon')]})], 'not know a place called'),
    ([says({'steps': [step('go_to', target={'class': 'gun'})]})], "Unknown class 'gun'"),
    ([says({'steps': [step('go_to', target={'class': 'mug', 'id': 'x'})]})], 'anything called'),
    ([says({'steps': [step('go_to', target={'class': ['mug']})]})], 'not text'),
    ([says({'steps': [step('turn', direction=['left'])]})], 'one of left'),
    ([says({'steps': [step('turn', direction='left', topic='/cmd_vel')]})], "no argument 'topic'"),
    ([says({'steps': [step('turn', direction='left')] * 200})], '200 steps'),
    ([says({'steps': [{'skill': 'turn', 'arguments': 'left'}]})], 'not a JSON object'),
    ([says({'steps': [step('hand_over')]})], 'not be holding anything'),
    ([says({'steps': [step('pick', object={'class': 'mug'})]})], 'Manipulation is not running'),
    ([(200, hangs)], 'did not answer in time'),
    ([(200, trickles)], 'did not answer in time'),
    ([(200, floods)], 'too long'),
]


@pytest.mark.parametrize('answers, said', BAD)
def test_answers_that_cannot_be_used(answers: list[Any], said: str) -> None:
    """One sentence says why, in time, and without the key."""
    begin_s = time.monotonic()
    with serving(ModelStub(*answers)) as stub, pytest.raises(ModelError) as caught:
        asked(stub, 1.5 if 'time' in said else 60.0)
    assert said in str(caught.value) and KEY not in str(caught.value)
    assert time.monotonic() - begin_s < 60.0 and len(stub.asked) <= 5


def test_a_server_that_is_not_there() -> None:
    """The sentence asks whether the address is right."""
    for url in ('http://127.0.0.1:1/v1', 'nonsense', 'http://[', ''):
        with pytest.raises(ModelError, match='Is it running, and is the parameter base_url right'):
            ModelServer(url, 'any').answer([], {}, time.monotonic() + 2.0)


def test_a_refusal_is_said_to_the_person() -> None:
    """As the model words it, in one line that is not endless."""
    with serving(ModelStub(says({'steps': [], 'refusal': 'No.\n\n' + 'x' * 900}))) as stub:
        outcome = asked(stub)
    assert isinstance(outcome, Refusal) and outcome.text.startswith('No. x')
    assert len(outcome.text) == 300


def test_the_only_model_is_asked() -> None:
    """Of several, somebody has to choose; the key is sent as the interface asks."""
    with serving(ModelStub(says(GOOD))) as stub:
        asked(stub)
        assert stub.asked[0]['model'] == 'small-model' and stub.asked[0]['temperature'] == 0
        assert stub.headers[0]['Authorization'] == f'Bearer {KEY}'
        stub.models = ['a', 'b']
        with pytest.raises(ModelError, match='several models: a, b'):
            asked(stub)
        assert told(asked(stub, model='b')) == 'go to the hall' and stub.asked[-1]['model'] == 'b'
        stub.models = []
        with pytest.raises(ModelError, match='has no models'):
            asked(stub)


def test_the_format_that_works_is_kept() -> None:
    """The next question does not try the others again."""
    with serving(ModelStub(takes_no_format)) as stub:
        server = ModelServer(stub.url, 'any')
        planner = ModelPlanner(SKILLS, server.answer, 60.0)
        planner.plan('go to the hall', WORLD)
        count = len(stub.asked)
        planner.plan('go to the hall', WORLD)
    assert count == 3 and len(stub.asked) == 4


def test_all_kinds_of_arguments_are_read() -> None:
    """Nulls are left out; descriptions, lists and whole numbers become what plans have."""
    red = {'class': 'mug', 'colour': 'red', 'which': None, 'place': 'desk', 'id': None}
    steps = [
        step('find', object=red),
        step('move', direction='backward', distance=1),
        step('turn', direction='left', angle=None),
        step('follow_path', places=['hall', 'study']),
        step('describe', target=None, relation=None),
        step('look_at', target={'class': 'mug', 'id': 'red_mug_1'}),
    ]
    with serving(ModelStub(says({'steps': steps, 'refusal': None}))) as stub:
        assert told(asked(stub)) == (
            'find the red mug on the desk; move backward by 1 metres; turn left; '
            'walk through the hall and the study; say what I see; look at the mug'
        )


def test_the_schema_is_in_the_subset_of_all_servers() -> None:
    """All fields are required, nothing else is allowed, and no number has a limit."""

    def visit(schema: Any) -> None:
        if isinstance(schema, list):
            for each in schema:
                visit(each)
        if not isinstance(schema, dict):
            return
        if schema.get('type') == 'object':
            assert schema['required'] == list(schema['properties'])
            assert schema['additionalProperties'] is False
        assert not {'minimum', 'maximum', 'maxItems', 'const', 'default'} & {*schema}
        for each in schema.values():
            visit(each)

    schema = plan_schema(SKILLS, WORLD)
    visit(schema)
    names = [
        each['properties']['skill']['enum'][0]
        for each in schema['properties']['steps']['items']['anyOf']
    ]
    assert 'go_to' in names and 'bring' not in names and len(names) > MOST_STEPS


def test_the_model_is_told_what_there_is() -> None:
    """Places, things and skills, and the wish as data, cut to its length."""
    with serving(ModelStub(says(GOOD))) as stub:
        server = ModelServer(stub.url, 'any')
        ModelPlanner(SKILLS, server.answer, 60.0).plan('x"}' * 400, WORLD)
    system, user = (each['content'] for each in stub.asked[0]['messages'])
    assert 'red_mug_1' in system and 'desk' in system and 'Manipulation is not running.' in system
    assert len(json.loads(user)['wish']) == 500 and 'cmd_vel' not in system
