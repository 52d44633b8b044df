# SPDX-License-Identifier: Apache-2.0
"""Load the skills from a file such as skills.yaml."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
import math
from pathlib import Path
from typing import Any

from ament_index_python.packages import get_package_share_directory
from humanoid_common.errors import UserError
from humanoid_common.naming import did_you_mean
from humanoid_common.paths import expanded_path
from humanoid_common.tables import load_table, SourceLocation, Table
from llm_planner.phrases import parse_phrase, part_of, Phrase, Slot, with_rules
from llm_planner.skills import (
    Argument,
    LEAVES,
    NEEDS,
    Saying,
    Skill,
    Skills,
    SkillStep,
    TYPES,
    UNITS,
)

__all__ = ['load_skills', 'skills_path']

_RULES = {
    'place': 'place_name', 'places': 'places', 'object': 'object', 'objects': 'objects',
    'target': 'target',
}  # fmt: skip
"""The rules of the slots of arguments, by type; numbers, choices and texts have their own."""
_NEEDED_RULES = ('beginning', 'joint', 'end', 'object', 'objects', 'place_name', 'target')
_ARGUMENT_KEYS = ('type', 'values', 'unit', 'at_least', 'at_most', 'default')
_SKILL_KEYS = (
    'summary', 'arguments', 'server', 'without', 'needs', 'leaves', 'timeout', 'attempts', 'steps',
    'does', 'says', 'phrases',
)  # fmt: skip
_PARTS = ('rules', 'vocabulary', 'weights', 'skills')
_KINDS_OF_PLACES = ('inside', 'surface', 'room')
"""Lists of places that come from the world, beside `place`."""
_WEIGHTS = (0.001, 1000.0)
_MOST_TIMEOUT_S = 3600.0


def skills_path(given: str = '') -> Path:
    """
    Locate the skills file.

    Parameters
    ----------
    given
        A path, which may begin with `~`; empty for the file of this package.

    Raises
    ------
    UserError
        It begins with a home folder that does not exist.

    """
    if given:
        return expanded_path(given)
    return Path(get_package_share_directory('llm_planner')) / 'config' / 'skills.yaml'


def load_skills(path: Path) -> Skills:
    """
    Load a skills file.

    Parameters
    ----------
    path
        A YAML file; the one of this package documents the format.

    Raises
    ------
    TableError
        The file cannot be read, or something in it is missing, unknown or invalid.

    """
    top = load_table(path)
    top.allow(*_PARTS)
    given, lists, weights, tables = (top.table(name) for name in _PARTS)
    rules = {name: _phrase(given.value(name), given.at(name)) for name in given.names}
    for name in _NEEDED_RULES:
        if name not in rules:
            raise given.place.missing(name)
    vocabulary = {name: _words(lists.table(name)) for name in lists.names}
    found = Skills(
        {name: _skill(name, tables.table(name)) for name in tables.names},
        rules,
        vocabulary,
        {word: weights.number(word, None, _WEIGHTS) for word in weights.names},
    )
    for skill in found:
        tables.at(skill.name).checked(partial(_check_steps, skill, found))
        tables.at(skill.name).checked(partial(_check_slots, skill, found))
    known = {*rules, *vocabulary, *_KINDS_OF_PLACES}
    for name, phrase in rules.items():
        for part in part_of(phrase):
            if isinstance(part, Slot) and part.rule not in known:
                raise given.at(name).error(
                    f"{given.at(name).name} has the slot '{part.rule}', which is not defined."
                )
    return found


def _skill(name: str, table: Table) -> Skill:
    table.allow(*_SKILL_KEYS)
    given = table.table('arguments')
    arguments = {key: _argument(key, given.table(key)) for key in given.names}
    server = table.table('server')
    server.allow('action', 'service')
    if len(server.names) > 1:
        raise server.place.error(
            f"the skill '{name}' has two servers; give an action or a service."
        )
    kind = next(iter(server.names), '')
    steps = tuple(map(_step, table.tables('steps')))
    if steps and kind:
        raise table.place.error(f"the skill '{name}' has both steps and a server.")
    return Skill(
        name,
        table.text('summary'),
        arguments,
        kind,
        server.text(kind) if kind else '',
        table.text('without', ''),
        _some_of(table, 'needs', NEEDS),
        _some_of(table, 'leaves', LEAVES),
        table.number('timeout', 60.0, (0.1, _MOST_TIMEOUT_S)),
        table.integer('attempts', 1, (1, 10)),
        steps,
        _templates(table, 'does', arguments),
        ' '.join(_templates(table, 'says', arguments)),
        tuple(
            _saying(name, arguments, entry, table.at('phrases').item(number, _line(entry)))
            for number, entry in enumerate(_list(table, 'phrases'))
        ),
    )


def _argument(name: str, table: Table) -> Argument:
    table.allow(*_ARGUMENT_KEYS)
    kind = table.choice('type', TYPES)
    values = _words(table.table('values'))
    if (kind == 'choice') != bool(values):
        raise table.place.error(
            f'{table.place.name}: a choice needs values, and only a choice has them.'
        )
    unit = table.text('unit', '')
    if (kind == 'number') != (unit in UNITS):
        raise table.place.error(
            f'{table.place.name}: a number, and only a number, has a unit: {", ".join(UNITS)}.'
        )
    default = table.value('default')
    if default is not None and kind == 'number':
        default = table.number('default')
    elif default is not None and kind == 'choice':
        default = table.choice('default', [*values])
    return Argument(
        name,
        kind,
        values,
        unit,
        table.number('at_least') if table.has('at_least') else -math.inf,
        table.number('at_most') if table.has('at_most') else math.inf,
        default,
    )


def _saying(
    skill: str, arguments: Mapping[str, Argument], entry: Any, place: SourceLocation
) -> Saying:
    """Parse a phrase: a text, or a table of one text and the arguments that it implies."""
    constants: Mapping[str, Any] = {}
    if isinstance(entry, dict) and len(entry) == 1:
        [(entry, constants)] = entry.items()
        Table(constants, place).allow(*arguments)
    own = {name: _RULES.get(each.kind, f'{skill}_{name}') for name, each in arguments.items()}
    return Saying(with_rules(_phrase(entry, place), own), dict(constants))


def _line(entry: Any) -> int:
    """Return the line of a list item; 0, which is unknown, unless it is a table."""
    return getattr(entry, 'line', 0)


def _phrase(text: Any, place: SourceLocation) -> Phrase:
    """Parse a phrase; an error has its location."""
    if not isinstance(text, str) or not text:
        raise place.wrong('a string', text)
    return place.checked(lambda: parse_phrase(text))


def _step(table: Table) -> SkillStep:
    if len(table.names) != 1:
        raise table.place.error(f'{table.place.name} must be one skill with its arguments.')
    [skill] = table.names
    given = table.table(skill)
    is_unless = given.has('unless') and bool(given.choice('unless', ('holding',)))
    texts = {name: given.text(name) for name in given.names if name not in ('unless', 'if')}
    return SkillStep(skill, texts, is_unless, given.text('if', ''))


def _check_steps(skill: Skill, skills: Skills) -> None:
    """Validate that steps are simple skills, and that their arguments exist."""
    for step in skill.steps:
        other = skills.skills.get(step.skill)
        if other is None or other.steps:
            hint = did_you_mean(step.skill, skills.skills)
            raise UserError(
                f"the skill '{skill.name}' has the step '{step.skill}', which is not a simple "
                f'skill. {hint}'
            )
        for name, source in step.arguments.items():
            if name not in other.arguments or source.split('.')[0] not in skill.arguments:
                raise UserError(
                    f"the step '{step.skill}' of the skill '{skill.name}' takes {name} from "
                    f'{source}, and one of them is not an argument.'
                )


def _check_slots(skill: Skill, skills: Skills) -> None:
    """Validate that the slots of phrases are arguments, or refer to rules or word lists."""
    own = {f'{skill.name}_{name}' for name in skill.arguments}
    known = {*skills.rules, *skills.vocabulary, *_KINDS_OF_PLACES, *own}
    for saying in skill.sayings:
        for part in part_of(saying.phrase):
            if isinstance(part, Slot) and part.rule not in known:
                raise UserError(
                    f"a phrase of the skill '{skill.name}' has the slot '{part.rule}', which is "
                    f'not defined. {did_you_mean(part.rule, known)}'
                )


def _templates(table: Table, name: str, arguments: Mapping[str, Argument]) -> tuple[str, ...]:
    """Read texts in which `{argument}` stands for an argument: one, or a list, or none."""
    value, place = table.value(name), table.at(name)
    texts = tuple(value) if isinstance(value, list) else (value,) if value else ()
    for text in texts:
        if not isinstance(text, str) or not text:
            raise place.wrong('a string', text)
        try:
            text.format_map(dict.fromkeys(arguments, ''))
        except (KeyError, IndexError, ValueError) as error:
            raise place.error(
                f'{place.name} is {text!r}, with an unknown argument: {error}.'
            ) from None
    return texts


def _list(table: Table, name: str) -> list[Any]:
    """Read a list; one that is not set is empty."""
    values = table.value(name) if table.has(name) else []
    if not isinstance(values, list):
        raise table.at(name).wrong('a list', values)
    return values


def _some_of(table: Table, name: str, known: Sequence[str]) -> tuple[str, ...]:
    """Read a list of known words."""
    values = _list(table, name)
    for value in values:
        if value not in known:
            raise table.at(name).not_among(known, str(value))
    return tuple(values)


def _words(table: Table) -> dict[str, tuple[str, ...]]:
    """Read the list of words for each value."""
    found = {}
    for value in table.names:
        words = table.value(value)
        if not isinstance(words, list) or not all(isinstance(word, str) for word in words):
            raise table.at(value).wrong('a list of words', words)
        found[value] = tuple(words)
    return found
