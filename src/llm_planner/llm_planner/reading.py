# SPDX-License-Identifier: Apache-2.0
"""Interpretation of the clauses of a sentence as steps with arguments."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from llm_planner.dialogue import AskFirstError, Dialogue, Question
from llm_planner.grammar import Bindings
from llm_planner.plan import PlanError, Step, UnavailableError
from llm_planner.skills import Argument, Saying, Skill, Skills
from llm_planner.world import ANYTHING, base_name, in_words, listed, ObjectDescription, World

__all__ = ['Clause', 'Reading']

_ASKING = frozenset(('find', 'where', 'describe', 'identify', 'count', 'tell_count'))
"""Skills for which an ambiguous description needs no clarification."""
_UNKNOWN = 'something'
"""The name of a held object whose class is unknown."""


@dataclass(frozen=True)
class Clause:
    """A phrase of a skill matched in a sentence: its bindings, and its range of words."""

    skill: Skill
    saying: Saying
    bindings: Bindings
    begin: int
    end: int

    @property
    def is_free(self) -> bool:
        """Whether it contains free text."""
        return any(
            name in self.skill.arguments and self.skill.arguments[name].kind == 'text'
            for name, _ in self.bindings
        )


class Reading:
    """
    Interpreter that turns the clauses of a sentence into steps, one after another.

    Parameters
    ----------
    skills
        The skills that the robot can be asked for.
    world
        The state of the world: places, objects, the robot and its hand.
    dialogue
        The dialogue context, with the choices that were answered; it is not changed.

    Attributes
    ----------
    steps
        The steps so far.
    last_object, last_place
        The object and the place that were mentioned last, to which pronouns refer.

    """

    def __init__(self, skills: Skills, world: World, dialogue: Dialogue) -> None:
        self._skills, self._world, self._dialogue = skills, world, dialogue
        self.last_object, self.last_place = dialogue.last_object, dialogue.last_place
        self.steps: list[Step] = []
        self._held: ObjectDescription | str = world.holding
        self._command = ''

    def read(self, clause: Clause, command: str) -> None:
        """
        Append the steps of a clause to `steps`. Call once per clause, in order.

        Parameters
        ----------
        clause
            The clause.
        command
            The whole sentence, which is planned again when a question about it was answered.

        Raises
        ------
        AskFirstError
            Several objects or places fit.
        UnavailableError
            Several objects fit, and the skill cannot be done with any of them now.
        PlanError
            A pronoun refers to nothing.

        """
        self._command = command
        skill, bindings = clause.skill, dict(clause.bindings)
        arguments: dict[str, Any] = {}
        for name, argument in skill.arguments.items():
            if name in clause.saying.constants:
                arguments[name] = clause.saying.constants[name]
            elif name in bindings:
                arguments[name] = self._value(bindings[name], argument, skill)
        if not skill.steps:
            self._add(Step(skill.name, arguments))
            return
        for step in skill.steps:
            if step.unless_holding and self._holds(arguments.get('object')):
                continue
            if step.only_if and not _field(arguments, step.only_if):
                continue
            values = {name: _field(arguments, source) for name, source in step.arguments.items()}
            self._add(Step(step.skill, values))

    def described_object(self, bindings: Bindings) -> ObjectDescription:
        """
        Build the description of an object from the bindings of the rule `object`.

        Parameters
        ----------
        bindings
            The bindings of the slots of the rule.

        Returns
        -------
        ObjectDescription
            For a pronoun, the object that was mentioned last.

        Raises
        ------
        PlanError
            A pronoun refers to nothing.
        AskFirstError
            Several places fit.

        """
        said: dict[str, Any] = dict(bindings)
        if 'pronoun' in said:
            if self.last_object is not None:
                return self.last_object
            raise PlanError('I do not know what you mean by "it": please name the object.')
        return self._described(said, said.get('class', ''), said.get('article') != 'indefinite')

    def _described(
        self, said: Mapping[str, Any], class_id: str, is_definite: bool
    ) -> ObjectDescription:
        if not class_id:  # the red one
            class_id = self.last_object.class_id if self.last_object else ANYTHING
        where = dict(said.get('where', ()))
        place = self._place(where['place_name']) if 'place_name' in where else ''
        return ObjectDescription(
            class_id,
            said.get('colour', ''),
            said.get('which', ''),
            place,
            is_inside=place in (*self._world.rooms, *self._world.containers),
            is_definite=is_definite,
        )

    def _value(self, raw: Any, argument: Argument, skill: Skill) -> Any:
        """Convert the binding of a slot to the value of an argument."""
        if argument.kind == 'place':
            return self._place(raw)
        if argument.kind == 'places':
            return tuple(self._place(value) for _, value in raw)
        if argument.kind in ('number', 'choice', 'text'):
            return raw
        if argument.kind == 'objects':
            said = dict(raw)
            self.last_object = self._described(said, said.get('classes', ANYTHING), False)
            return self.last_object
        inner = dict(raw)
        if argument.kind == 'target' and 'place_name' in inner:
            return self._place(inner['place_name'])
        bindings = inner['object'] if argument.kind == 'target' else raw
        if 'pronoun' in dict(bindings) and self._held and self._is_about_held(skill):
            return self._held_object()
        if 'pronoun' in dict(bindings) and self.last_object is None and self.last_place:
            return self.last_place
        found = self._distinct(self.described_object(bindings), skill)
        self.last_object = found
        return found

    def _place(self, bindings: Bindings) -> str:
        """Resolve a place name: the only match, the one in the room mentioned last, or ask."""
        names: tuple[str, ...] = dict(bindings)['place']
        if names in self._dialogue.chosen:
            names = (self._dialogue.chosen[names],)
        elif len(names) > 1 and self.last_place:
            room = self._world.places.get(self.last_place, self.last_place)
            there = tuple(each for each in names if self._world.places.get(each) == room)
            names = there if len(there) == 1 else names
        if len(names) > 1:
            labels = {f'the {in_words(each)}': each for each in names}
            raise AskFirstError(
                Question(
                    f'{listed(list(labels), "or")}?'.capitalize(), self._command, names, labels
                )
            )
        self.last_place = names[0]
        return names[0]

    def _distinct(self, described: ObjectDescription, skill: Skill) -> ObjectDescription:
        """Raise AskFirstError if several remembered objects fit and it matters which is meant."""
        if described in self._dialogue.chosen:
            chosen: ObjectDescription = self._dialogue.chosen[described]
            return chosen
        if skill.name in _ASKING or not described.is_definite or described.which:
            return described
        things = described.among(self._world.things, self._world.robot)
        if len(things) < 2 or described.class_id == ANYTHING:
            return described
        labels: dict[str, ObjectDescription] = {}
        if len({each.colour for each in things}) == len(things):
            labels = {
                f'the {each.colour or "other"} one': replace(described, colour=each.colour)
                for each in things
            }
        elif len({base_name(each.place) for each in things}) == len(things):
            labels = {
                f'the one on the {in_words(each.place)}'
                if each.place
                else 'the one on the floor': replace(described, object_id=each.object_id)
                for each in things
            }
        if not labels:
            return described
        for name in sorted(self._skills.simple(skill.name) & {*self._world.missing}):
            raise UnavailableError(self._world.missing[name])  # whichever one is meant
        what = f'Which {in_words(described.class_id)}: {listed(sorted(labels), "or")}?'
        raise AskFirstError(Question(what, self._command, described, labels))

    def _add(self, step: Step) -> None:
        self.steps.append(step)
        leaves = self._skills[step.skill].leaves
        if 'holding' in leaves:
            self._held = step.arguments.get('object', 'something')
        elif 'empty_hand' in leaves:
            self._held = ''

    def _is_about_held(self, skill: Skill) -> bool:
        """Check whether a pronoun can refer to the held object in a skill."""
        return any(step.unless_holding for step in skill.steps)

    def _held_object(self) -> ObjectDescription:
        """Return the description of the object that the hand will hold by then."""
        if isinstance(self._held, ObjectDescription):
            return self._held
        colour, _, class_id = self._held.rpartition(' ')
        return ObjectDescription(ANYTHING if class_id == _UNKNOWN else class_id, colour)

    def _holds(self, wanted: Any) -> bool:
        """Check whether the hand will hold the wanted object by then."""
        if not self._held:
            return False
        if isinstance(self._held, ObjectDescription):
            return bool(wanted == self._held)
        return isinstance(wanted, ObjectDescription) and wanted.names(self._held)


def _field(arguments: Mapping[str, Any], source: str) -> Any:
    """Return an argument, or a field of one: `objects.place`."""
    name, _, attribute = source.partition('.')
    value = arguments.get(name)
    return getattr(value, attribute, '') if attribute else value
