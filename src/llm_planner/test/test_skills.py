# SPDX-License-Identifier: Apache-2.0
"""The file of skills: that of this package, and what is wrong with others."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from humanoid_common.errors import UserError
from llm_planner.actions import Actions
from llm_planner.skills_file import load_skills, skills_path
import pytest
import yaml

OWN = Path(__file__).parents[1] / 'config' / 'skills.yaml'


def test_the_own_file() -> None:
    """It has all skills, and what they need in common."""
    skills = load_skills(OWN)
    assert {
        *('go_to', 'find', 'look_at', 'pick', 'place', 'bring', 'hand_over', 'put_into'),
        *('follow_path', 'turn', 'move', 'wait', 'wave', 'point_at', 'count', 'describe', 'say'),
        *('come_back', 'stop', 'tidy'),
    } <= {*skills.skills}
    assert skills['pick'].needs == ('standing', 'empty_hand')
    assert skills.simple('bring') == {'find', 'go_to', 'pick', 'come_back', 'hand_over'}
    assert {each.name for each in skills if not each.sayings} == {'pick', 'tell_count'}
    assert all(skill.steps or skill.does for skill in skills)
    assert skills.weights['the'] > 1.0


def test_each_simple_skill_is_implemented() -> None:
    """And nothing is that is not in the file: there it is put together from others."""
    assert {each.name for each in load_skills(OWN) if not each.steps} == Actions.IMPLEMENTED


def test_the_installed_file() -> None:
    """Without a path, it is the one of this package; ~ is the home folder."""
    assert load_skills(skills_path()).skills
    assert skills_path('~/mine.yaml') == Path.home() / 'mine.yaml'


CHANGES: list[tuple[tuple[str, ...], Any, str]] = [
    (('skills', 'go_to', 'summry'), 'x', "has an unknown key 'summry'. Did you mean 'summary'?"),
    (('skills', 'go_to', 'summary'), 3, 'skills.go_to.summary must be a string, but is 3'),
    (('skills', 'go_to', 'timeout'), -1, 'a finite number from 0.1 to 3600, but is -1'),
    (('skills', 'go_to', 'timeout'), True, 'a finite number from 0.1'),
    (
        ('skills', 'go_to', 'needs'),
        ['legs'],
        "must be one of standing, holding, empty_hand, but is 'legs'",
    ),
    (('skills', 'go_to', 'needs'), 'standing', "must be a list, but is 'standing'"),
    (
        ('skills', 'go_to', 'arguments', 'target', 'type'),
        'planet',
        'must be one of place, places, ',
    ),
    (('skills', 'go_to', 'phrases'), ['go (to'], 'is not closed'),
    (('skills', 'go_to', 'phrases'), ['go to {target:moon}'], "the slot 'moon', which is not"),
    (('skills', 'go_to', 'phrases'), ['go (to | /0/ at) {target}'], 'write one such as /0.1/'),
    (('skills', 'go_to', 'phrases'), [{'go': {'speed': 3}}], "unknown key 'speed'"),
    (('skills', 'go_to', 'does'), 'go to {place}', 'unknown argument'),
    (('skills', 'go_to', 'server'), {'action': 'a', 'service': 'b'}, 'two servers'),
    (('skills', 'move', 'arguments', 'distance', 'unit'), 'miles', 'has a unit'),
    (('skills', 'wave', 'arguments', 'arm', 'default'), 'third', 'arm.default must be one of '),
    (('skills', 'take', 'steps'), [{'fnd': {}}], "Did you mean 'find'?"),
    (('skills', 'take', 'steps'), [{'bring': {}}], 'is not a simple skill'),
    (('skills', 'take', 'steps'), [{'find': {'object': 'cat'}}], 'takes object from cat'),
    (
        ('skills', 'take', 'steps'),
        [{'find': {'unless': 'tired'}}],
        "must be one of holding, but is 'tired'",
    ),
    (('rules', 'joint'), None, 'rules.joint must be a string, but is empty'),
    (('rules', 'where'), 'on {moon}', "the slot 'moon', which is not defined"),
    (
        ('vocabulary', 'colour'),
        {'red': 'red'},
        "vocabulary.colour.red must be a list of words, but is 'red'",
    ),
    (('weights', 'the'), 0, 'weights.the must be a finite number from 0.001 to 1000, but is 0'),
    (('weights', 'the'), 'often', "but is 'often'"),
    (('skils',), {}, "Did you mean 'skills'?"),
]


@pytest.mark.parametrize('path, value, said', CHANGES)
def test_a_wrong_file_is_refused(
    tmp_path: Path, path: tuple[str, ...], value: Any, said: str
) -> None:
    """One sentence says where and why."""
    table = yaml.safe_load(OWN.read_text())
    part = table
    for key in path[:-1]:
        part = part[key]
    part[path[-1]] = value
    file = tmp_path / 'skills.yaml'
    file.write_text(yaml.safe_dump(table))
    with pytest.raises(UserError) as caught:
        load_skills(file)
    assert said in str(caught.value) and str(file) in str(caught.value)


@pytest.mark.parametrize('text', ['skills: [', '[]', '', 'skills: 3', '\x00'])
def test_what_is_no_file_of_skills(tmp_path: Path, text: str) -> None:
    """Text of any kind ends in a sentence."""
    file = tmp_path / 'skills.yaml'
    file.write_text(text)
    with pytest.raises(UserError, match=r'skills\.yaml.* (is not a valid|must be a mapping)'):
        load_skills(file)
    with pytest.raises(UserError, match='cannot be read'):
        load_skills(tmp_path / 'nothing.yaml')
