# SPDX-License-Identifier: Apache-2.0
"""What the robot says instead of planning: refusals and questions; and what answers mean."""

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
    """Why there is no plan, as a sentence for the person who asked."""

    text: str


@dataclass(frozen=True)
class Question:
    """
    What has to be known before there is a plan.

    Attributes
    ----------
    text
        The question.
    command
        What had been asked for.
    subject
        What several things fit: an `ObjectDescription`, or a tuple of names of places; None if
        it is asked whether `command` was meant; the `Plan`, if whether that is to be done.
    choices
        What can be answered, and what each answer means.

    """

    text: str
    command: str
    subject: Any
    choices: Mapping[str, Any]

    @property
    def is_yes_or_no(self) -> bool:
        """Whether it is answered by yes or no."""
        return self.subject is None or isinstance(self.subject, Plan)


@dataclass
class Dialogue:
    """What was spoken about before, so that `it` and answers can be understood."""

    last_object: ObjectDescription | None = None
    last_place: str = ''
    question: Question | None = None
    chosen: dict[Any, Any] = field(default_factory=dict)
    """What was answered, by the subject of the question; for the sentence that is planned."""


class AskFirstError(PlanError):
    """Several things fit."""

    def __init__(self, question: Question) -> None:
        super().__init__(question.text)
        self.question = question


def answer_to(tokens: Sequence[str], question: Question) -> str | None:
    """
    Return the choice that an answer names; None if it names none, or several.

    Parameters
    ----------
    tokens
        The words of the answer. Some are enough: `red` for `the red one`, or `the second`; `no`
        is an answer to each question that can be answered by yes.
    question
        What was asked.

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
    Return the question whether a plan is to be done.

    Parameters
    ----------
    plan, skills
        The plan, and what its steps are.
    when
        Which plans are asked about: `always` all, `motion` those that move the robot, `never`
        none.

    """
    is_motion = any(moves(step, skills) for step in plan.steps)
    if when == 'never' or (when == 'motion' and not is_motion):
        return None
    steps = [words_for(step, skills[step.skill]) for step in plan.steps]
    return Question(f'Shall I {listed(steps)}?', plan.command, plan, {'yes': plan, 'no': None})


def with_answers(jsgf: str, *, asks_to_confirm: bool) -> str:
    """
    Return the grammar of a speech recogniser with what answers questions.

    Parameters
    ----------
    jsgf
        The grammar of commands, with the public rule `<command>`.
    asks_to_confirm
        Whether there are questions for yes or no.

    """
    answers = ['the (first | second | third) one']
    if '\n<colour> = ' in jsgf:
        answers.append('the <colour> one')
    if asks_to_confirm:
        answers += ['yes [please]', 'no [thank you]']
    public = 'public <command> = '
    return f'{jsgf.replace(public, f"{public}<answer> | ", 1)}<answer> = {" | ".join(answers)};\n'
