# SPDX-License-Identifier: Apache-2.0
"""Describe what the robot can be asked for, as skills.yaml has it."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module
import math
from pathlib import Path
from typing import Any

INTRODUCTION = """\
# The skills

What the robot can be asked for, in the order of
[skills.yaml](../../src/llm_planner/config/skills.yaml), from which this page is made. How to ask,
and how to add skills of your own: [how-to/tell_the_robot.md](../how-to/tell_the_robot.md).

An argument with a default may be left out. A skill that consists of others is done by those;
plans of other programs, and those of language models, name only skills that do not.
"""
TYPES = {
    'place': 'the name of a place or room',
    'places': 'names of places and rooms, parted by commas',
    'object': 'an object, as described in words: `the red mug on the desk`',
    'objects': 'objects, as described in words: `red mugs on the desk`',
    'target': 'the name of a place or room, or an object in words',
    'text': 'a text',
}
NEEDS = {
    'standing': 'the robot stands',
    'holding': 'the hand holds something',
    'empty_hand': 'the hand is empty',
}
MOST_SENTENCES = 4


def lines(root: Path) -> Iterator[str]:
    """
    Yield the lines of the page of skills.

    Parameters
    ----------
    root
        The folder of the project.

    Yields
    ------
    str
        Markdown; a text may have several lines.

    """
    skills = load(root)
    yield INTRODUCTION
    for skill in skills:
        yield f'## {skill.name}\n'
        yield f'{skill.summary}\n'
        yield from _arguments(skill)
        yield '| | |'
        yield '|---|---|'
        for name, text in _facts(skill):
            yield f'| {name} | {text} |'
        if skill.sayings:
            said = sentences(skill, skills)[:MOST_SENTENCES]
            yield f'| for instance | {"; ".join(f"*{each}*" for each in said)} |'
        yield ''


def all_sentences(root: Path) -> list[str]:
    """
    Return an example of each phrase of each skill.

    Parameters
    ----------
    root
        The folder of the project.

    """
    skills = load(root)
    return [each for skill in skills for each in sentences(skill, skills)]


def sentences(skill: Any, skills: Any) -> list[str]:
    """
    Return an example of each phrase of a skill.

    Parameters
    ----------
    skill, skills
        The skill, and all skills of the project.

    """
    examples = import_module('llm_planner.examples')
    return list(examples.examples(skill, skills, examples.fixed_words()))


def load(root: Path) -> Any:
    """
    Load the skills of the project from skills.yaml.

    Parameters
    ----------
    root
        The folder of the project.

    """
    path = root / 'src' / 'llm_planner' / 'config' / 'skills.yaml'
    return import_module('llm_planner.skills_file').load_skills(path)


def _arguments(skill: Any) -> Iterator[str]:
    if not skill.arguments:
        return
    yield '| argument | type | default |'
    yield '|---|---|---|'
    for argument in skill.arguments.values():
        yield f'| `{argument.name}` | {_kind(argument)} | {_default(argument)} |'
    yield ''


def _kind(argument: Any) -> str:
    """Say what an argument may be."""
    if argument.kind == 'choice':
        return ', '.join(
            f'`{value}` ({", ".join(words)})' if (*words,) != (value,) else f'`{value}`'
            for value, words in argument.values.items()
        )
    if argument.kind != 'number':
        return TYPES[argument.kind]
    limits = [
        f'{word} {limit:g}'
        for word, limit in (('from', argument.at_least), ('to', argument.at_most))
        if math.isfinite(limit)
    ]
    return ' '.join((f'a number of {argument.unit},', *limits)).rstrip(',')


def _default(argument: Any) -> str:
    if argument.default is None:
        return 'has to be given'
    if argument.default == '':
        return 'none'
    if argument.kind == 'number':
        return f'{argument.default:g}'
    return f'`{argument.default}`'


def _facts(skill: Any) -> Iterator[tuple[str, str]]:
    """Yield what has to be so for a skill, and what it does, in words."""
    if skill.steps:
        steps = []
        for step in skill.steps:
            condition = ' unless that is held' * step.unless_holding
            if step.only_if:
                condition = ' if a place is given'
            steps.append(f'[{step.skill}](#{step.skill}){condition}')
        yield 'consists of', ', '.join(steps)
    if skill.server:
        yield 'needs running', f'{skill.server_kind} `{skill.server}`; else: "{skill.without}"'
    if skill.needs:
        yield 'needs', ', '.join(NEEDS[each] for each in skill.needs)
    if skill.leaves:
        yield 'leaves', ', '.join(NEEDS[each] for each in skill.leaves)
    if not skill.steps:
        tried = f', at most {skill.attempts} attempts' if skill.attempts > 1 else ''
        yield 'timeout', f'{skill.timeout_s:g} s{tried}'
    if skill.does:
        yield 'in a plan', '; '.join(f'`{each}`' for each in skill.does)
    if skill.says:
        yield 'says', f'`{skill.says}`'
