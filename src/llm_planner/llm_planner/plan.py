# SPDX-License-Identifier: Apache-2.0
"""Plans: steps with arguments, and their validation."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
import math
from typing import Any

from humanoid_common.errors import UserError
from humanoid_common.naming import did_you_mean, shortened
from llm_planner.skills import Argument, Skill, Skills
from llm_planner.world import in_words, listed, ObjectDescription, World

__all__ = [
    'MOST_STEPS', 'Plan', 'PlanError', 'Step', 'UnavailableError', 'check', 'moves', 'words_for',
]  # fmt: skip

MOST_STEPS = 12
_LONGEST_TEXT = 300


class PlanError(UserError):
    """A plan is invalid; the message tells the user why."""


class UnavailableError(PlanError):
    """A plan needs something that the robot cannot do now."""


@dataclass(frozen=True)
class Step:
    """
    A step of a plan.

    Attributes
    ----------
    skill
        The name of the skill.
    arguments
        By name: a place name, an `ObjectDescription`, a number, a value of a choice, a text, or a
        tuple of place names.

    """

    skill: str
    arguments: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Plan:
    """A command, and the steps that fulfil it."""

    command: str
    steps: tuple[Step, ...]
    source: str = 'rules'


def check(plan: Plan, skills: Skills, world: World) -> None:
    """
    Validate a plan: reject what the robot may not do, or cannot do now.

    Every plan is validated here, whoever made it: only known skills, existing values, numbers
    within their limits, at most `MOST_STEPS` steps, in an order in which each step can follow the
    previous one.

    Parameters
    ----------
    plan
        The plan.
    skills, world
        The available skills, and the state of the world.

    Raises
    ------
    PlanError
        The plan is invalid.
    UnavailableError
        The plan is valid, but cannot be executed now.

    """
    if not plan.steps:
        raise PlanError('There is nothing to do in this plan.')
    if len(plan.steps) > MOST_STEPS:
        raise PlanError(
            f'That would be {len(plan.steps)} steps; I do at most {MOST_STEPS} at once.'
        )
    is_holding = bool(world.holding)
    for step in plan.steps:
        skill = skills.skills.get(step.skill)
        if skill is None or skill.steps:
            hint = did_you_mean(step.skill, skills.skills)
            raise PlanError(f"I have no skill '{shortened(step.skill)}'. {hint}".strip())
        _check_arguments(step, skill, skills, world)
        if step.skill in world.missing:
            raise UnavailableError(world.missing[step.skill])
        if 'standing' in skill.needs and world.inhibition:
            raise UnavailableError(world.inhibition)
        if 'holding' in skill.needs and not is_holding:
            raise PlanError(
                f'I cannot {words_for(step, skill)}: I would not be holding anything by then.'
            )
        if 'empty_hand' in skill.needs and is_holding:
            raise PlanError(f'I cannot {words_for(step, skill)}: my hand would not be empty.')
        is_holding = (is_holding or 'holding' in skill.leaves) and 'empty_hand' not in skill.leaves


def _check_arguments(step: Step, skill: Skill, skills: Skills, world: World) -> None:
    for name in step.arguments:
        if name not in skill.arguments:
            raise PlanError(f"{skill.name} has no argument '{shortened(name)}'.")
    for argument in skill.arguments.values():
        value = step.arguments.get(argument.name, argument.default)
        if value is None:
            raise PlanError(f"{skill.name} needs '{argument.name}'.")
        if argument.name in step.arguments:
            _check_value(value, argument, skills, world)


def _check_value(value: Any, argument: Argument, skills: Skills, world: World) -> None:
    """Validate the value of an argument."""
    if isinstance(value, ObjectDescription):
        if argument.kind not in ('object', 'objects', 'target'):
            raise PlanError(f'{argument.name} has to be of type {argument.kind}, not an object.')
        _check_object(value, skills, world)
    elif argument.kind in ('object', 'objects'):
        raise PlanError(f'{argument.name} has to be an object, such as a red mug.')
    elif argument.kind == 'number':
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise PlanError(f'{argument.name} has to be a number of {argument.unit}.')
        if not math.isfinite(value) or not argument.at_least <= value <= argument.at_most:
            raise PlanError(
                f'{value:g} {argument.unit} is out of my range of {argument.at_least:g} to '
                f'{argument.at_most:g} {argument.unit}.'
            )
    elif argument.kind == 'choice':
        if not isinstance(value, str) or value not in argument.values:
            raise PlanError(f'{argument.name} has to be one of {", ".join(argument.values)}.')
    elif argument.kind == 'places':
        if not isinstance(value, tuple) or not value:
            raise PlanError(f'{argument.name} has to be a list of places.')
        for place in value:
            _check_place(place, world)
    elif not isinstance(value, str):
        raise PlanError(f'{argument.name} has to be a string.')
    elif argument.kind == 'text':
        if len(value) > _LONGEST_TEXT:
            raise PlanError(f'{argument.name} is longer than {_LONGEST_TEXT} characters.')
    elif value or argument.default is None:
        _check_place(value, world)


def _check_object(value: ObjectDescription, skills: Skills, world: World) -> None:
    """Validate a description: its words must be known, and its object id remembered."""
    for name, given in (
        ('class', value.class_id),
        ('colour', value.colour),
        ('which', value.which),
    ):
        known = skills.vocabulary.get(name, {})
        if given and given not in known:
            hint = did_you_mean(given, known) or f'I know {listed(list(known))}.'
            raise PlanError(f"Unknown {name} '{shortened(given)}'. {hint}")
    if value.place:
        _check_place(value.place, world)
    ids = {each.object_id for each in world.things}
    if value.object_id and value.object_id not in ids:
        raise PlanError(f"I do not remember anything called '{shortened(value.object_id)}'.")


def _check_place(place: Any, world: World) -> None:
    if place in world.place_names:
        return
    if not world.place_names:
        raise PlanError(
            'I do not know any places: start me with a file of named places (places_file).'
        )
    name = shortened(str(place))
    hint = did_you_mean(name, world.place_names) or (
        f'I know {listed([in_words(each) for each in world.place_names])}.'
    )
    raise PlanError(f"I do not know a place called '{in_words(name)}'. {hint}")


def moves(step: Step, skills: Skills) -> bool:
    """
    Check whether a step moves the robot: body, arm or head.

    Parameters
    ----------
    step, skills
        The step, and the skills. A skill with an action server moves, one that needs to stand
        walks, and one with a target goes to it or looks at it.

    """
    skill = skills[step.skill]
    return (
        skill.server_kind == 'action'
        or 'standing' in skill.needs
        or any(
            argument.kind in ('target', 'place') and bool(step.arguments.get(name))
            for name, argument in skill.arguments.items()
        )
    )


def words_for(step: Step, skill: Skill) -> str:
    """
    Phrase a step as an imperative: `go to the kitchen`.

    Parameters
    ----------
    step, skill
        The step, and its skill; the first template whose arguments the step has is used.

    """
    said = {
        name: value_in_words(step.arguments[name], argument)
        for name, argument in skill.arguments.items()
        if step.arguments.get(name) not in (None, '')
    }
    for template in skill.does:
        try:
            return template.format_map(said)
        except KeyError:  # an argument that is not given
            continue
    return skill.name.replace('_', ' ')


def value_in_words(value: Any, argument: Argument | None = None) -> str:
    """
    Phrase the value of an argument in natural language.

    Parameters
    ----------
    value
        The value, as in a `Step`.
    argument
        Its type, which gives numbers their unit; without it, a text is the name of a place.

    """
    if isinstance(value, ObjectDescription):
        return value.plural_text if argument and argument.kind == 'objects' else value.text
    if isinstance(value, tuple):
        return listed([f'the {in_words(each)}' for each in value])
    if isinstance(value, (int, float)):
        return f'{value:g} {argument.unit if argument else ""}'.strip()
    is_place = argument is None or argument.kind in ('place', 'target')
    return f'the {in_words(value)}' if is_place else str(value)
