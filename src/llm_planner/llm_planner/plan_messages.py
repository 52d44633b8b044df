# SPDX-License-Identifier: Apache-2.0
"""Conversion of plans to and from messages, whose text arguments are parsed by type."""

from __future__ import annotations

from typing import Any

from diagnostic_msgs.msg import KeyValue
from humanoid_interfaces.msg import Plan as PlanMessage
from humanoid_interfaces.msg import PlanStep
from llm_planner.plan import Plan, PlanError, Step, words_for
from llm_planner.rules import RulePlanner
from llm_planner.skills import Argument
from llm_planner.world import ObjectDescription, World

__all__ = ['plan_message', 'plan_of']


def plan_message(plan: Plan, planner: RulePlanner) -> PlanMessage:
    """
    Convert a plan to a message, with its steps in words.

    Parameters
    ----------
    plan
        A plan of known skills.
    planner
        The rule planner, which has the skills.

    """
    steps = []
    for step in plan.steps:
        arguments = [
            KeyValue(key=name, value=_text(value)) for name, value in step.arguments.items()
        ]
        text = words_for(step, planner.skills[step.skill])
        steps.append(PlanStep(skill=step.skill, arguments=arguments, text=text))
    return PlanMessage(command=plan.command, source=plan.source, steps=steps)


def plan_of(message: PlanMessage, planner: RulePlanner, world: World) -> Plan:
    """
    Convert a message from any source to a plan, without validating it.

    Parameters
    ----------
    message
        A plan. An object is given by its description or its id; places are separated by commas.
    planner, world
        The rule planner and the state of the world, to look up skills and objects.

    Raises
    ------
    PlanError
        An argument cannot be parsed.

    """
    steps = []
    for step in message.steps:
        skill = planner.skills.skills.get(step.skill)
        known = skill.arguments if skill else {}
        arguments = {
            each.key: _value(each.value, known[each.key], planner, world)
            if each.key in known
            else each.value
            for each in step.arguments
        }
        steps.append(Step(step.skill, arguments))
    return Plan(message.command, tuple(steps), message.source)


def _text(value: Any) -> str:
    if isinstance(value, ObjectDescription):
        return value.object_id or value.text
    if isinstance(value, tuple):
        return ', '.join(value)
    return f'{value:g}' if isinstance(value, (int, float)) else str(value)


def _value(text: str, argument: Argument, planner: RulePlanner, world: World) -> Any:
    if argument.kind == 'number':
        try:
            return float(text)
        except ValueError:
            raise PlanError(f"{argument.name} is '{text[:40]}', which is not a number.") from None
    if argument.kind == 'places':
        return tuple(each.strip() for each in text.split(','))
    is_object = argument.kind in ('object', 'objects') or (
        argument.kind == 'target' and text and text not in world.place_names
    )
    if not is_object:
        return text
    for thing in world.things:
        if thing.object_id == text:
            return ObjectDescription(thing.class_id, thing.colour, object_id=text)
    return planner.object_of(text, world)
