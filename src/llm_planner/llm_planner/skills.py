# SPDX-License-Identifier: Apache-2.0
"""Data model of the skills that the robot can be asked for."""

from __future__ import annotations

from collections.abc import Generator, Iterator, Mapping
from dataclasses import dataclass, field
import math
from typing import Any

from humanoid_common.errors import UserError
from llm_planner.phrases import Phrase

__all__ = [
    'LEAVES', 'NEEDS', 'TYPES', 'UNITS', 'Argument', 'Saying', 'Skill', 'SkillError', 'SkillRun',
    'SkillStep', 'Skills',
]  # fmt: skip

TYPES = ('place', 'places', 'object', 'objects', 'target', 'number', 'choice', 'text')
NEEDS = ('standing', 'holding', 'empty_hand')
LEAVES = ('holding', 'empty_hand')
UNITS = ('metres', 'degrees', 'seconds')

SkillRun = Generator[None, None, None]
"""A running skill: it yields once per tick, returns on success and raises `SkillError` if not.

Closing it cancels pending work, such as a goal that was sent.
"""


class SkillError(UserError):
    """
    A skill has failed; the message tells the user why.

    Attributes
    ----------
    code
        The name of an error code of the `ExecutePlan` result.
    is_final
        Whether a retry is pointless.

    """

    def __init__(self, text: str, code: str = 'FAILED', *, is_final: bool = False) -> None:
        super().__init__(text)
        self.code, self.is_final = code, is_final


@dataclass(frozen=True)
class Argument:
    """
    An argument of a skill.

    Attributes
    ----------
    name, kind
        Its name, and one of `TYPES`.
    values
        Of a choice: the words for each value.
    unit, at_least, at_most
        Of a number.
    default
        Its value if it is not given; None if it is required.

    """

    name: str
    kind: str
    values: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    unit: str = ''
    at_least: float = -math.inf
    at_most: float = math.inf
    default: Any = None


@dataclass(frozen=True)
class Saying:
    """A phrase that asks for a skill, and the argument values that it implies without a slot."""

    phrase: Phrase
    constants: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class SkillStep:
    """A step of a compound skill; its arguments refer to those of the compound skill."""

    skill: str
    arguments: Mapping[str, str]
    unless_holding: bool = False
    only_if: str = ''
    """The argument, or `argument.place`, without which the step is skipped."""


@dataclass(frozen=True)
class Skill:
    """
    A skill: what it does, what it needs, and the phrases that ask for it.

    Attributes
    ----------
    server_kind, server
        `action` or `service`, and its name; both empty if it needs no server.
    without
        What the robot says if the server is not running.
    needs, leaves
        The preconditions and effects: some of `NEEDS` and `LEAVES`.
    timeout_s, attempts
        The time limit, and the maximum number of attempts.
    steps
        The skills of which a compound skill consists; empty for a simple one.

    """

    name: str
    summary: str
    arguments: Mapping[str, Argument] = field(default_factory=dict)
    server_kind: str = ''
    server: str = ''
    without: str = ''
    needs: tuple[str, ...] = ()
    leaves: tuple[str, ...] = ()
    timeout_s: float = 60.0
    attempts: int = 1
    steps: tuple[SkillStep, ...] = ()
    does: tuple[str, ...] = ()
    """Imperatives with `{argument}`s that describe it; the first with all arguments is used."""
    says: str = ''
    sayings: tuple[Saying, ...] = ()


@dataclass(frozen=True)
class Skills:
    """
    All skills, in the order of their file, with the rules and words that they share.

    Attributes
    ----------
    skills
        By name.
    rules
        Phrases that are parts of others, by name.
    vocabulary
        Words by the name of their list and the value that they stand for.
    weights
        How likely words are for a speech recogniser, in comparison with others; 1 by default.

    """

    skills: Mapping[str, Skill]
    rules: Mapping[str, Phrase] = field(default_factory=dict)
    vocabulary: Mapping[str, Mapping[str, tuple[str, ...]]] = field(default_factory=dict)
    weights: Mapping[str, float] = field(default_factory=dict)

    def __getitem__(self, name: str) -> Skill:
        return self.skills[name]

    def __iter__(self) -> Iterator[Skill]:
        return iter(self.skills.values())

    def simple(self, name: str) -> frozenset[str]:
        """
        Resolve a skill into the simple skills that it consists of.

        Parameters
        ----------
        name
            The name of a skill.

        Returns
        -------
        frozenset of str
            Their names; only its own if it is simple.

        """
        steps = self.skills[name].steps
        if not steps:
            return frozenset((name,))
        return frozenset().union(*(self.simple(each.skill) for each in steps))
