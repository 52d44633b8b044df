# SPDX-License-Identifier: Apache-2.0
"""Responses other than plans (refusals and questions), and the interpretation of answers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from llm_planner.grammar import tokenized
from llm_planner.plan import moves, Plan, PlanError, words_for
from llm_planner.skills import Skills
from llm_planner.world import listed, ObjectDescription

__all__ = [
    'AskFirstError', 'Dialogue', 'Question', 'Refusal', 'answer_to', 'confirmation',
    'with_answers',
]  # fmt: skip

_FILLERS = frozenset(('the', 'one', 'please', 'it', 'is', 'i', 'mean', 'a', 'that', 'take'))
_NO = frozenset(('no', 'nope', 'nah', 'not', 'do', "don't", 'now', 'thanks', 'thank', 'you'))
_REFUSING = frozenset(('no', 'nope', 'nah', 'not', "don't"))
_YES = frozenset(('yes', 'yeah', 'yep', 'right', 'correct', 'sure', 'exactly', 'do', 'ok', 'okay'))
_ORDINALS = ('first', 'second', 'third', 'fourth')


@dataclass(frozen=True)
class Refusal:
    """The reason why a command was rejected, as a message to the user."""

    text: str


@dataclass(frozen=True)
class Question:
    """
    A question, for clarification or confirmation, to be answered before a plan is executed.

    Attributes
    ----------
    text
        The question.
    command
        The command that led to the question.
    subject
        What is ambiguous: an `ObjectDescription`, or a tuple of place names; None if the question
        is whether `command` was meant; the `Plan`, if it is whether to execute that plan.
    choices
        The possible answers, and the meaning of each.

    """

    text: str
    command: str
    subject: Any
    choices: Mapping[str, Any]

    @property
    def is_yes_or_no(self) -> bool:
        """Whether the answer is yes or no."""
        return self.subject is None or isinstance(self.subject, Plan)


@dataclass
class Dialogue:
    """Dialogue context that resolves pronouns such as `it`, and answers to questions."""

    last_object: ObjectDescription | None = None
    last_place: str = ''
    question: Question | None = None
    chosen: dict[Any, Any] = field(default_factory=dict)
    """The choices made for the current command, by the subject of the question."""


class AskFirstError(PlanError):
    """The command is ambiguous: the user has to be asked first."""

    def __init__(self, question: Question) -> None:
        super().__init__(question.text)
        self.question = question


def answer_to(tokens: Sequence[str], question: Question) -> str | None:
    """
    Return the choice that an answer names; None if it names none, or several.

    Parameters
    ----------
    tokens
        The words of the answer. A part of the choice is enough: `red` for `the red one`, or `the
        second`; `no` answers every yes-or-no question.
    question
        The question.

    """
    said = [each for each in tokens if each not in _FILLERS and each != ',']
    labels = list(question.choices)
    if question.is_yes_or_no:
        if {*said} & _REFUSING and {*said} <= _NO:
            return 'no'
        return 'yes' if said and {*said} <= _YES else None
    if len(said) == 1 and said[0] in _ORDINALS and _ORDINALS.index(said[0]) < len(labels):
        return labels[_ORDINALS.index(said[0])]
    fits = [label for label in labels if said and {*said} <= {*tokenized(label)}]
    return fits[0] if len(fits) == 1 else None


def confirmation(plan: Plan, skills: Skills, when: str) -> Question | None:
    """
    Return the question that asks for confirmation of a plan; None if none is required.

    Parameters
    ----------
    plan, skills
        The plan, and the skills of its steps.
    when
        Which plans require confirmation: `always` all, `motion` those that move the robot,
        `never` none.

    """
    is_motion = any(moves(step, skills) for step in plan.steps)
    if when == 'never' or (when == 'motion' and not is_motion):
        return None
    steps = [words_for(step, skills[step.skill]) for step in plan.steps]
    return Question(f'Shall I {listed(steps)}?', plan.command, plan, {'yes': plan, 'no': None})


def with_answers(jsgf: str, *, asks_to_confirm: bool) -> str:
    """
    Add the answers to questions to the grammar of a speech recogniser.

    Parameters
    ----------
    jsgf
        The grammar of commands, with the public rule `<command>`.
    asks_to_confirm
        Whether yes-or-no questions are asked.

    """
    answers = ['the (first | second | third) one']
    if '\n<colour> = ' in jsgf:
        answers.append('the <colour> one')
    if asks_to_confirm:
        answers += ['yes [please]', 'no [thank you]']
    public = 'public <command> = '
    return f'{jsgf.replace(public, f"{public}<answer> | ", 1)}<answer> = {" | ".join(answers)};\n'
