# SPDX-License-Identifier: Apache-2.0
"""
Minimal networks of words that a decoder can search.

A nondeterministic automaton over words becomes a deterministic one (subset construction), and then
the minimal one (Moore's partition refinement); see Hopcroft, Motwani and Ullman, Introduction to
Automata Theory, chapters 2 and 4. Both keep the weights of the moves: of several moves with the
same word, the largest weight counts.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

__all__ = ['Moves', 'WordNetwork', 'minimal_network']

Moves = list[list[tuple[str, int, float]]]
"""For each state of an automaton, words with their target states and weights."""
_Table = list[dict[str, tuple[int, float]]]
"""For each state of a deterministic automaton, the target state and the weight of each word."""
_Ends = dict[int, float]
"""The weights of the final states."""
_Subset = frozenset[tuple[int, float]]
"""States of a nondeterministic automaton, each with the weight of the way to it since a word."""


@dataclass(frozen=True)
class WordNetwork:
    """
    A minimal deterministic finite automaton over words.

    Attributes
    ----------
    arcs
        For each state, the target state of each word. State 0 is the start state.
    finals
        The final states, in which a sentence may end.
    unknown
        The words of the grammar that were left out, in order of appearance.
    shown
        Sentences that the grammar itself gives as examples (`@example` in a documentation
        comment), as far as the network accepts them.
    weights
        For each state, the weight of each word: how much likelier it is than one of weight 1.
    ends
        For each final state, the weight of the end of the sentence.

    """

    arcs: tuple[Mapping[str, int], ...]
    finals: frozenset[int]
    unknown: tuple[str, ...] = ()
    shown: tuple[str, ...] = ()
    weights: tuple[Mapping[str, float], ...] = ()
    ends: Mapping[int, float] = field(default_factory=dict)

    def accepts(self, text: str) -> bool:
        """
        Check whether a text is a sentence of the grammar.

        Parameters
        ----------
        text
            Words as the grammar spells them, separated by spaces.

        """
        state = 0
        for word in text.split():
            if word not in self.arcs[state]:
                return False
            state = self.arcs[state][word]
        return state in self.finals


def minimal_network(moves: Moves, first: int, last: int) -> WordNetwork:
    """
    Compute the minimal deterministic automaton for a nondeterministic one.

    Parameters
    ----------
    moves
        The moves from each state; a move with an empty word is an epsilon move, whose weight
        counts for the words behind it.
    first, last
        The start state and the final state.

    Returns
    -------
    WordNetwork
        It accepts the same sentences; without any, it has no final state.

    """
    return _minimal(*_deterministic(moves, first, last))


def _deterministic(moves: Moves, first: int, last: int) -> tuple[_Table, _Ends]:
    """Build the equivalent deterministic automaton: the arcs of each state, and final states."""
    free: list[_Subset | None] = [None] * len(moves)

    def reached(state: int) -> _Subset:
        """Return the epsilon closure of a state: its states with words, and the last one."""
        found = free[state]
        if found is None:
            ways, todo = {state: 1.0}, [state]
            for each in todo:
                for word, target, weight in moves[each]:
                    if not word and target not in ways:
                        ways[target] = ways[each] * weight
                        todo.append(target)
            found = free[state] = frozenset(
                (each, weight)
                for each, weight in ways.items()
                if each == last or any(word for word, _, _ in moves[each])
            )
        return found

    start = reached(first)
    numbers, todo = {start: 0}, [start]
    table: _Table = [{}]
    ends: _Ends = {}
    while todo:
        subset = todo.pop()
        number = numbers[subset]
        targets: dict[str, set[tuple[int, float]]] = {}
        weights: dict[str, float] = {}
        for state, before in subset:
            if state == last:
                ends[number] = max(ends.get(number, 0.0), before)
            for word, target, weight in moves[state]:
                if word:
                    weights[word] = max(weights.get(word, 0.0), before * weight)
                    targets.setdefault(word, set()).update(reached(target))
        for word, states in targets.items():
            following = frozenset(states)
            if following not in numbers:
                numbers[following] = len(table)
                table.append({})
                todo.append(following)
            table[number][word] = numbers[following], weights[word]
    return table, ends


def _minimal(table: _Table, ends: _Ends) -> WordNetwork:
    """Merge equivalent states, and remove those that lead nowhere."""
    useful = _useful(table, {*ends})
    table = [{word: arc for word, arc in arcs.items() if arc[0] in useful} for arcs in table]
    classes = [0] * len(table)
    count = 0
    while True:
        signatures: dict[tuple[object, ...], int] = {}
        refined = []
        for state, arcs in enumerate(table):
            ways = frozenset((word, classes[target], w) for word, (target, w) in arcs.items())
            signature = (classes[state], ends.get(state), ways)
            refined.append(signatures.setdefault(signature, len(signatures)))
        classes = refined
        if len(signatures) == count:
            break
        count = len(signatures)
    reached, order = list(_in_order(table)), dict[int, int]()
    for state in reached:
        order.setdefault(classes[state], len(order))
    arcs_of: list[dict[str, int]] = [{} for _ in order]
    weights_of: list[dict[str, float]] = [{} for _ in order]
    for state in reached:
        number = order[classes[state]]
        for word, (target, weight) in table[state].items():
            arcs_of[number][word] = order[classes[target]]
            weights_of[number][word] = weight
    kept = {order[classes[state]]: w for state, w in ends.items() if classes[state] in order}
    return WordNetwork(tuple(arcs_of), frozenset(kept), weights=tuple(weights_of), ends=kept)


def _useful(table: _Table, finals: set[int]) -> set[int]:
    """Compute the states from which a final one is reachable."""
    sources: dict[int, set[int]] = {}
    for state, arcs in enumerate(table):
        for target, _ in arcs.values():
            sources.setdefault(target, set()).add(state)
    seen, todo = set(finals), list(finals)
    while todo:
        for state in sources.get(todo.pop(), ()):
            if state not in seen:
                seen.add(state)
                todo.append(state)
    return seen


def _in_order(table: _Table) -> Iterator[int]:
    """Yield the states reachable from the start state, in breadth-first order."""
    seen, todo = {0}, [0]
    for state in todo:
        yield state
        for target, _ in table[state].values():
            if target not in seen:
                seen.add(target)
                todo.append(target)
