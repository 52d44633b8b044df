# SPDX-License-Identifier: Apache-2.0
"""What the robot can be asked for: the skills."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
import math
from typing import Any

from llm_planner.phrases import Phrase

__all__ = [
    'LEAVES', 'NEEDS', 'TYPES', 'UNITS', 'Argument', 'Saying', 'Skill', 'SkillStep', 'Skills',
]  # fmt: skip

TYPES = ('place', 'places', 'object', 'objects', 'target', 'number', 'choice', 'text')
NEEDS = ('standing', 'holding', 'empty_hand')
LEAVES = ('holding', 'empty_hand')
UNITS = ('metres', 'degrees', 'seconds')


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
        What it is if it is not given; None if it has to be given.

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
    """A phrase that asks for a skill, and the arguments that it gives without a slot."""

    phrase: Phrase
    constants: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class SkillStep:
    """One of the skills that a compound skill consists of; arguments name those of the whole."""

    skill: str
    arguments: Mapping[str, str]
    unless_holding: bool = False
    only_if: str = ''
    """The argument, or `argument.place`, without which the step is left out."""


@dataclass(frozen=True)
class Skill:
    """
    A skill: what it does, what it needs, and the sentences that ask for it.

    Attributes
    ----------
    server_kind, server
        `action` or `service`, and its name; both empty if nothing has to run.
    without
        What the robot says if that is not running.
    needs, leaves
        What has to be so before, and is so afterwards: of `NEEDS` and `LEAVES`.
    timeout_s, attempts
        How long it may take, and how often it is tried.
    steps
        The skills that it consists of; none if it is done itself.

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
    """Words for it as an imperative, with `{argument}`s; the first whose arguments are given."""
    says: str = ''
    sayings: tuple[Saying, ...] = ()


@dataclass(frozen=True)
class Skills:
    """
    All skills, in the order of their file, with the words that they share.

    Attributes
    ----------
    skills
        By name.
    rules
        Phrases that are parts of others, by name.
    vocabulary
        Words by the name of their list and the value for which they stand.

    """

    skills: Mapping[str, Skill]
    rules: Mapping[str, Phrase] = field(default_factory=dict)
    vocabulary: Mapping[str, Mapping[str, tuple[str, ...]]] = field(default_factory=dict)

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
