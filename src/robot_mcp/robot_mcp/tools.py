# SPDX-License-Identifier: Apache-2.0
"""
The tools that are offered to assistants: one for each skill, and read-only ones.

Names, arguments and limits come from the skills file, as for every other planner. Calls of
assistants become plans here; `llm_planner.plan.check` decides whether they may be executed.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
import json
import math
from typing import Any

from llm_planner.dialogue import Dialogue
from llm_planner.model_planner import plan_from, plan_schema
from llm_planner.phrases import Word
from llm_planner.plan import Plan, PlanError
from llm_planner.reading import Clause, Reading
from llm_planner.skills import Argument, Saying, Skill, Skills
from llm_planner.world import World

__all__ = ['CONFIRMATION', 'LOOKS', 'STOP', 'TELL', 'Tool', 'plan_of_call', 'tools_of']

CONFIRMATION = 'confirmation'
"""The argument for the code that confirms a call."""
STOP, TELL = 'stop', 'tell'
LOOKS = {
    'robot_state': 'Where the robot is, what it is doing, what it can do now and what it cannot.',
    'remembered_objects': 'The objects that the robot remembers: id, class, colour, place, room '
    'and position in the map (m).',
    'named_places': 'The places and rooms that can be named in the arguments of other tools.',
    'camera_picture': 'What the camera in the head sees now, as a picture.',
    'map_picture': 'The map of the surroundings as a picture, with the robot in it.',
}
"""The read-only tools, with what they return."""
_SOURCE = 'mcp'
_LONGEST = 8000
"""No call of a skill needs more characters than this."""
_NOTES = {
    'object': 'An object: its class, and what distinguishes it from others.',
    'objects': 'Objects: their class, and what distinguishes them from others.',
    'target': 'The name of a place or room, or the description of an object.',
    'place': 'The name of a place or room.',
    'places': 'Names of places or rooms, in order.',
}


@dataclass(frozen=True)
class Tool:
    """
    A tool as an assistant sees it.

    Attributes
    ----------
    name, description
        The name, and the description for the model.
    schema
        The JSON schema of its arguments.
    acts
        Whether the robot does anything other than stop.

    """

    name: str
    description: str
    schema: Mapping[str, Any]
    acts: bool = False


def tools_of(skills: Skills, world: World, *, confirm: bool = False) -> list[Tool]:
    """
    List all tools.

    Parameters
    ----------
    skills, world
        The skills, and the state of the world, whose places become enums. Skills that are
        unavailable now are listed as well: clients list the tools once, and the robot may still be
        starting.
    confirm
        Whether calls may need a confirmation code.

    """
    more = {CONFIRMATION: _text('The confirmation code, if one was required.')} if confirm else {}
    sentence = _object({'sentence': _text('What the robot should do, in plain English.')} | more)
    sentence['required'] = ['sentence']
    return [
        Tool(STOP, skills[STOP].summary if STOP in skills.skills else 'Stop.', _object({})),
        *(Tool(name, text, _object({})) for name, text in LOOKS.items()),
        Tool(
            TELL,
            'Tell the robot in plain English what to do, such as "go to the kitchen and tell me '
            'what you see". It says so if it does not understand.',
            sentence,
            acts=True,
        ),
        *(
            Tool(each.name, each.summary, _schema(each, skills, world, more), acts=True)
            for each in skills
            if each.name not in (STOP, TELL, *LOOKS)
        ),
    ]


def plan_of_call(name: str, arguments: Mapping[str, Any], skills: Skills, world: World) -> Plan:
    """
    Convert a call of a skill to a plan, without validating it.

    Parameters
    ----------
    name, arguments
        The call: anything that an assistant may have sent.
    skills, world
        The skills, and the state of the world.

    Raises
    ------
    PlanError
        The call is no plan; the message states why.

    """
    skill = skills.skills.get(name)
    if skill is None:
        raise PlanError(f"I have no skill '{name[:80]}'.")
    try:
        # A model may have written anything: no part may look like a <think> tag or another plan.
        told = json.dumps({'steps': [{'skill': name, 'arguments': dict(arguments)}]})
    except (TypeError, ValueError, RecursionError):
        raise PlanError('The arguments are not valid JSON.') from None
    if len(told) > _LONGEST:
        raise PlanError(f'The arguments are too long: the limit is {_LONGEST} characters.')
    made = plan_from(name, told.replace('<', '\\u003c'), skills)
    if not isinstance(made, Plan):
        raise PlanError('That is not a plan.')
    steps = made.steps
    if skill.steps:
        given = steps[0].arguments
        for each in given:
            if each not in skill.arguments:
                raise PlanError(f"{name} has no argument '{each[:80]}'.")
        reading = Reading(skills, world, Dialogue())
        reading.read(Clause(skill, Saying(Word(name), given), (), 0, 0), name)
        steps = tuple(reading.steps)
    return Plan(name, steps, _SOURCE)


def _schema(skill: Skill, skills: Skills, world: World, more: Mapping[str, Any]) -> dict[str, Any]:
    """Build the JSON schema of the arguments of a skill from that of plans."""
    alone = Skills({skill.name: replace(skill, steps=())}, skills.rules, skills.vocabulary)
    plan = plan_schema(alone, world)
    step = plan['properties']['steps']['items']['anyOf'][0]
    schema = _relaxed(step['properties']['arguments'])
    for name, argument in skill.arguments.items():
        schema['properties'][name] = {
            **schema['properties'][name],
            **_limits(argument),
        }
    schema['properties'] |= more
    return schema


def _relaxed(schema: Mapping[str, Any]) -> dict[str, Any]:
    """Make the nullable properties of a schema optional instead."""
    if 'anyOf' in schema:
        options = [_relaxed(each) for each in schema['anyOf'] if each != {'type': 'null'}]
        return options[0] if len(options) == 1 else {'anyOf': options}
    relaxed = dict(schema)
    if isinstance(schema.get('type'), list):
        relaxed['type'] = next(each for each in schema['type'] if each != 'null')
    if 'items' in schema:
        relaxed['items'] = _relaxed(schema['items'])
    if 'properties' in schema:
        properties = schema['properties']
        relaxed['properties'] = {name: _relaxed(each) for name, each in properties.items()}
        relaxed['required'] = [name for name, each in properties.items() if not _can_be_null(each)]
    return relaxed


def _can_be_null(schema: Mapping[str, Any]) -> bool:
    return {'type': 'null'} in schema.get('anyOf', ()) or 'null' in schema.get('type', ())


def _limits(argument: Argument) -> dict[str, Any]:
    """Return the keywords for an argument that the schema of plans lacks."""
    told: dict[str, Any] = {}
    if argument.kind in _NOTES:
        told['description'] = _NOTES[argument.kind]
    if argument.kind == 'number':
        told['description'] = argument.unit
        if math.isfinite(argument.at_least):
            told['minimum'] = argument.at_least
        if math.isfinite(argument.at_most):
            told['maximum'] = argument.at_most
    if argument.default not in (None, ''):
        told['default'] = argument.default
    return told


def _object(properties: Mapping[str, Any]) -> dict[str, Any]:
    return {
        'type': 'object',
        'properties': dict(properties),
        'required': [],
        'additionalProperties': False,
    }


def _text(description: str) -> dict[str, Any]:
    return {'type': 'string', 'description': description}
