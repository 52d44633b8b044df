# SPDX-License-Identifier: Apache-2.0
"""Split a sentence into clauses, each of which matches a phrase of a skill."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from llm_planner.grammar import Grammar
from llm_planner.reading import Clause
from llm_planner.skills import Saying, Skill

__all__ = ['ClauseSearch', 'joints', 'skipped']


class ClauseSearch:
    """
    Backtracking parser that splits a sentence into clauses.

    Parameters
    ----------
    grammar, sayings
        The grammar, and the phrases that a clause can match.
    tokens
        The words and commas of the sentence.

    Attributes
    ----------
    furthest
        The furthest index at which a clause was tried so far; if parsing fails, nothing was
        understood from there on.

    """

    def __init__(
        self,
        grammar: Grammar,
        sayings: Sequence[tuple[Skill, Saying]],
        tokens: Sequence[str],
    ) -> None:
        self._grammar, self._sayings, self._tokens = grammar, sayings, tokens
        self._needs_joint = True
        self._found: dict[int, list[Clause]] = {}
        self._hopeless: set[int] = set()
        self.furthest = 0

    def first(self, at: int = 0, *, needs_joint: bool = True) -> list[Clause] | None:
        """
        Return the best parse of the sentence from an index on; None if there is none.

        Parameters
        ----------
        at
            The index of the first word.
        needs_joint
            Whether clauses have to be separated, by a comma or a word such as `and`. A speech
            recogniser hears no commas.

        """
        self._needs_joint = needs_joint
        self._hopeless.clear()
        return next(self._readings(at), None)

    def _readings(self, at: int) -> Iterator[list[Clause]]:
        """Yield each parse of the sentence from an index on."""
        if at in self._hopeless:
            return
        is_hopeless = True
        for clause, ends in self._clauses(at):
            for end in ends:
                if end == len(self._tokens):
                    is_hopeless = False
                    yield [clause]
                    continue
                for after in self._next_begins(end):
                    for rest in self._readings(after):
                        is_hopeless = False
                        yield [clause, *rest]
        if is_hopeless:
            self._hopeless.add(at)

    def _clauses(self, at: int) -> Iterator[tuple[Clause, list[int]]]:
        """Yield the clauses that can follow, each with the indices behind its optional ending."""
        grammar, tokens = self._grammar, self._tokens
        for begin in skipped(grammar, 'beginning', tokens, at):
            if begin not in self._found:
                self._found[begin] = list(self._clauses_at(begin))
            self.furthest = max(self.furthest, begin if begin < len(tokens) else 0)
            for clause in self._found[begin]:
                yield clause, skipped(grammar, 'end', tokens, clause.end)

    def _clauses_at(self, at: int) -> Iterator[Clause]:
        if at >= len(self._tokens):
            return
        word, grammar = self._tokens[at], self._grammar
        matches = []
        for skill, saying in self._sayings:
            beginnings = grammar.beginnings(saying.phrase)
            if beginnings is None or word in beginnings:
                matches += [
                    Clause(skill, saying, bindings, at, end)
                    for end, bindings in grammar.matches(saying.phrase, self._tokens, at)
                ]
        seen = set()
        # Longest match first, but shortest first for free text, so that the rest can be parsed.
        for clause in sorted(matches, key=lambda each: each.end if each.is_free else -each.end):
            key = (clause.end, clause.skill.name)
            if key not in seen:  # one parse of the same words per skill is enough
                seen.add(key)
                yield clause

    def _next_begins(self, at: int) -> Iterator[int]:
        yield from joints(self._grammar, self._tokens, at)
        if not self._needs_joint:
            yield at


def skipped(grammar: Grammar, rule: str, tokens: Sequence[str], at: int) -> list[int]:
    """
    Return the indices reached by matching a rule any number of times.

    Parameters
    ----------
    grammar, rule
        The grammar, and the name of the rule: `beginning` or `end`.
    tokens, at
        The words, and the index of the first one.

    """
    reached = [at]
    for place in reached:
        start = place + 1 if place < len(tokens) and tokens[place] == ',' else place
        for end, _ in grammar.matches(grammar.rules[rule], tokens, start):
            if end not in reached:
                reached.append(end)
    return [*reached[1:], at]


def joints(grammar: Grammar, tokens: Sequence[str], at: int) -> Iterator[int]:
    """
    Yield the indices at which the next clause can start, behind its separator.

    Parameters
    ----------
    grammar
        Its rule `joint` has the words that separate clauses; commas do so as well.
    tokens, at
        The words, and the index behind a clause.

    """
    after_comma = at
    while after_comma < len(tokens) and tokens[after_comma] == ',':
        after_comma += 1
    for end, _ in grammar.matches(grammar.rules['joint'], tokens, after_comma):
        yield end
    if after_comma > at:
        yield after_comma
