# SPDX-License-Identifier: Apache-2.0
"""What the robot says instead of planning: refusals and questions; and what answers mean."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from llm_planner.grammar import tokenized
from llm_planner.plan import PlanError
from llm_planner.world import ObjectDescription

__all__ = ['AskFirstError', 'Dialogue', 'Question', 'Refusal', 'answer_to']

_FILLERS = frozenset(('the', 'one', 'please', 'it', 'is', 'i', 'mean', 'a', 'that', 'take'))
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
        it is asked whether `command` was meant.
    choices
        What can be answered, and what each answer means.

    """

    text: str
    command: str
    subject: Any
    choices: Mapping[str, Any]


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
        The words of the answer. Some are enough: `red` for `the red one`, or `the second`.
    question
        What was asked.

    """
    said = [each for each in tokens if each not in _FILLERS and each != ',']
    labels = list(question.choices)
    if question.subject is None:
        return 'yes' if said and {*said} <= _YES else None
    if len(said) == 1 and said[0] in _ORDINALS and _ORDINALS.index(said[0]) < len(labels):
        return labels[_ORDINALS.index(said[0])]
    fits = [label for label in labels if said and {*said} <= {*tokenized(label)}]
    return fits[0] if len(fits) == 1 else None
