# SPDX-License-Identifier: Apache-2.0
"""Load the skills from a file such as skills.yaml."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
import math
from pathlib import Path
from typing import Any

from ament_index_python.packages import get_package_share_directory
from humanoid_common.errors import UserError
from humanoid_common.naming import did_you_mean
from humanoid_common.paths import expanded_path
from llm_planner.phrases import GrammarError, parse_phrase, part_of, Slot, with_rules
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
import yaml

__all__ = ['SkillsError', 'load_skills', 'skills_path']

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
_MOST_TIMEOUT_S = 3600.0


class SkillsError(UserError):
    """A skills file is invalid; the message states why."""


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
    SkillsError
        The file cannot be read, or something in it is missing, unknown or invalid.

    """
    try:
        table = yaml.safe_load(path.read_text(encoding='utf-8'))
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise SkillsError(f'The skills in {path} cannot be read: {error}') from error
    try:
        return _skills(table)
    except (SkillsError, GrammarError) as error:
        raise SkillsError(f'The skills in {path} cannot be used: {error}') from None


def _skills(table: Any) -> Skills:
    top = _table(table, 'the file', ('skills', 'rules', 'vocabulary'))
    rules = {
        str(name): parse_phrase(_text(phrase, f'the rule {name}'))
        for name, phrase in _table(top.get('rules'), 'rules').items()
    }
    for name in _NEEDED_RULES:
        if name not in rules:
            raise SkillsError(f"there is no rule '{name}'.")
    vocabulary = {
        str(name): _words(values, f'vocabulary {name}')
        for name, values in _table(top.get('vocabulary'), 'vocabulary').items()
    }
    skills = {
        str(name): _skill(str(name), entry)
        for name, entry in _table(top.get('skills'), 'skills').items()
    }
    found = Skills(skills, rules, vocabulary)
    for skill in found:
        _check_steps(skill, found)
    parts = (part for phrase in rules.values() for part in part_of(phrase))
    slots = {part.rule for part in parts if isinstance(part, Slot)}
    for slot in sorted(slots - {*rules, *vocabulary}):
        raise SkillsError(f"a rule has the slot '{slot}', which is not defined.")
    return found


def _skill(name: str, entry: Any) -> Skill:
    what = f"the skill '{name}'"
    table = _table(entry, what, _SKILL_KEYS)
    arguments = {
        str(key): _argument(str(key), each, what)
        for key, each in _table(table.get('arguments'), f'the arguments of {what}').items()
    }
    server = _table(table.get('server'), f'the server of {what}', ('action', 'service'))
    if len(server) > 1:
        raise SkillsError(f'{what} has two servers; give an action or a service.')
    kind, server_name = next(iter(server.items()), ('', ''))
    timeout_s = _number(table.get('timeout', 60.0), f'the timeout of {what}', 0.1, _MOST_TIMEOUT_S)
    steps = tuple(
        _step(each, f'a step of {what}') for each in _list(table.get('steps'), f'steps of {what}')
    )
    if steps and server:
        raise SkillsError(f'{what} has both steps and a server.')
    return Skill(
        name,
        _text(table.get('summary'), f'the summary of {what}'),
        arguments,
        kind,
        str(server_name),
        str(table.get('without', '')),
        _some_of(table.get('needs'), NEEDS, f'what {what} needs'),
        _some_of(table.get('leaves'), LEAVES, f'what {what} leaves'),
        timeout_s,
        int(_number(table.get('attempts', 1), f'the attempts of {what}', 1, 10)),
        steps,
        _templates(table.get('does'), arguments, f'does of {what}'),
        ' '.join(_templates(table.get('says'), arguments, f'says of {what}')),
        tuple(
            _saying(name, arguments, each)
            for each in _list(table.get('phrases'), f'the phrases of {what}')
        ),
    )


def _argument(name: str, entry: Any, of: str) -> Argument:
    what = f"the argument '{name}' of {of}"
    table = _table(entry, what, _ARGUMENT_KEYS)
    kind = table.get('type')
    if kind not in TYPES:
        raise SkillsError(f'{what} has the type {kind!r}. Give one of {", ".join(TYPES)}.')
    values = _words(table['values'], what) if kind == 'choice' and 'values' in table else {}
    if (kind == 'choice') != bool(values):
        raise SkillsError(f'{what}: a choice needs values, and only a choice has them.')
    unit = str(table.get('unit', ''))
    if (kind == 'number') != (unit in UNITS):
        raise SkillsError(f'{what}: a number, and only a number, has a unit: {", ".join(UNITS)}.')
    argument = Argument(
        name,
        kind,
        values,
        unit,
        _number(table.get('at_least', -math.inf), what, -math.inf, math.inf),
        _number(table.get('at_most', math.inf), what, -math.inf, math.inf),
        table.get('default'),
    )
    if kind == 'choice' and argument.default is not None and argument.default not in values:
        raise SkillsError(
            f'{what} has the default {argument.default!r}, which is not one of its values.'
        )
    return argument


def _saying(skill: str, arguments: Mapping[str, Argument], entry: Any) -> Saying:
    """Parse a phrase: a text, or a table of one text and the arguments that it implies."""
    constants: Mapping[str, Any] = {}
    if isinstance(entry, dict) and len(entry) == 1:
        [(entry, constants)] = entry.items()
    phrase = parse_phrase(_text(entry, f"a phrase of the skill '{skill}'"))
    own = {name: _RULES.get(each.kind, f'{skill}_{name}') for name, each in arguments.items()}
    for name in constants:
        if name not in arguments:
            raise SkillsError(f"the phrase '{entry}' gives '{name}', which is not an argument.")
    return Saying(with_rules(phrase, own), dict(constants))


def _step(entry: Any, what: str) -> SkillStep:
    if not isinstance(entry, dict) or len(entry) != 1:
        raise SkillsError(f'{what} is {entry!r}. Give a skill with its arguments.')
    [(skill, given)] = entry.items()
    table = dict(_table(given, what))
    unless = table.pop('unless', '')
    if unless not in ('', 'holding'):
        raise SkillsError(f"{what} has unless: {unless!r}. There is only 'holding'.")
    only_if = str(table.pop('if', ''))
    texts = {str(key): str(value) for key, value in table.items()}
    return SkillStep(str(skill), texts, unless == 'holding', only_if)


def _check_steps(skill: Skill, skills: Skills) -> None:
    """Validate that steps are simple skills, and that their arguments exist."""
    for step in skill.steps:
        other = skills.skills.get(step.skill)
        if other is None or other.steps:
            hint = did_you_mean(step.skill, skills.skills)
            raise SkillsError(
                f"the skill '{skill.name}' has the step '{step.skill}', which is not a simple "
                f'skill. {hint}'
            )
        for name, source in step.arguments.items():
            if name not in other.arguments or source.split('.')[0] not in skill.arguments:
                raise SkillsError(
                    f"the step '{step.skill}' of the skill '{skill.name}' takes {name} from "
                    f'{source}, and one of them is not an argument.'
                )


def _templates(value: Any, arguments: Mapping[str, Argument], what: str) -> tuple[str, ...]:
    """Validate and return texts in which `{argument}` stands for an argument."""
    texts = tuple(value) if isinstance(value, list) else (value,) if value else ()
    for text in texts:
        try:
            _text(text, what).format_map(dict.fromkeys(arguments, ''))
        except (KeyError, IndexError, ValueError) as error:
            raise SkillsError(f'{what} is {text!r}, with an unknown argument: {error}.') from None
    return texts


def _table(value: Any, what: str, keys: Iterable[str] = ()) -> Mapping[str, Any]:
    if value is None:
        return {}
    if not isinstance(value, dict):
        raise SkillsError(f'{what} is {value!r}, but has to be a mapping.')
    known = list(keys)
    for key in value:
        if known and key not in known:
            hint = did_you_mean(str(key), known) or ', '.join(known)
            raise SkillsError(f"{what} has no key '{key}'. {hint}")
    return value


def _list(value: Any, what: str) -> list[Any]:
    if value is None:
        return []
    if not isinstance(value, list):
        raise SkillsError(f'{what} is {value!r}, but has to be a list.')
    return value


def _text(value: Any, what: str) -> str:
    if not isinstance(value, str) or not value:
        raise SkillsError(f'{what} is {value!r}, but has to be a string.')
    return value


def _number(value: Any, what: str, at_least: float, at_most: float) -> float:
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    if not is_number or not at_least <= value <= at_most:
        raise SkillsError(f'{what} is {value!r}; give a number from {at_least:g} to {at_most:g}.')
    return float(value)


def _some_of(value: Any, known: Iterable[str], what: str) -> tuple[str, ...]:
    for each in _list(value, what):
        if each not in known:
            raise SkillsError(f'{what} is {each!r}. Give some of {", ".join(known)}.')
    return tuple(value or ())


def _words(values: Any, what: str) -> dict[str, tuple[str, ...]]:
    """Parse the lists of words for each value."""
    found = {}
    for value, words in _table(values, what).items():
        if not isinstance(words, list) or not all(isinstance(each, str) for each in words):
            raise SkillsError(f'the words for {value!r} in {what} are {words!r}; give a list.')
        found[str(value)] = tuple(words)
    return found
