# SPDX-License-Identifier: Apache-2.0
"""
Minimal networks of words that a decoder can search.

A nondeterministic automaton over words becomes a deterministic one (subset construction), and then
the minimal one (Moore's partition refinement); see Hopcroft, Motwani and Ullman, Introduction to
Automata Theory, chapters 2 and 4.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

__all__ = ['Moves', 'WordNetwork', 'minimal_network']

Moves = list[list[tuple[str, int]]]
"""For each state of an automaton, words with their target states."""
_Table = list[dict[str, int]]


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

    """

    arcs: tuple[Mapping[str, int], ...]
    finals: frozenset[int]
    unknown: tuple[str, ...] = ()
    shown: tuple[str, ...] = ()

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
        The moves from each state; a move with an empty word is an epsilon move.
    first, last
        The start state and the final state.

    Returns
    -------
    WordNetwork
        It accepts the same sentences; without any, it has no final state.

    """
    return _minimal(*_deterministic(moves, first, last))


def _deterministic(moves: Moves, first: int, last: int) -> tuple[_Table, set[int]]:
    """Build the equivalent deterministic automaton: the arcs of each state, and final states."""
    free: list[frozenset[int] | None] = [None] * len(moves)

    def reached(state: int) -> frozenset[int]:
        """Return the epsilon closure of a state: its states with words, and the last one."""
        found = free[state]
        if found is None:
            seen, todo = {state}, [state]
            while todo:
                for word, target in moves[todo.pop()]:
                    if not word and target not in seen:
                        seen.add(target)
                        todo.append(target)
            found = free[state] = frozenset(
                each for each in seen if each == last or any(word for word, _ in moves[each])
            )
        return found

    start = reached(first)
    numbers, todo = {start: 0}, [start]
    table: _Table = [{}]
    finals: set[int] = {0} if last in start else set()
    while todo:
        subset = todo.pop()
        targets: dict[str, set[int]] = {}
        for state in subset:
            for word, target in moves[state]:
                if word:
                    targets.setdefault(word, set()).update(reached(target))
        arcs = table[numbers[subset]]
        for word, states in targets.items():
            following = frozenset(states)
            if following not in numbers:
                numbers[following] = len(table)
                table.append({})
                todo.append(following)
                if last in following:
                    finals.add(numbers[following])
            arcs[word] = numbers[following]
    return table, finals


def _minimal(table: _Table, finals: set[int]) -> WordNetwork:
    """Merge equivalent states, and remove those that lead nowhere."""
    useful = _useful(table, finals)
    table = [{word: target for word, target in arcs.items() if target in useful} for arcs in table]
    classes = [int(state in finals) for state in range(len(table))]
    count = 0
    while True:
        signatures: dict[tuple[object, ...], int] = {}
        refined = []
        for state, arcs in enumerate(table):
            ways = frozenset((word, classes[target]) for word, target in arcs.items())
            signature = (classes[state], ways)
            refined.append(signatures.setdefault(signature, len(signatures)))
        classes = refined
        if len(signatures) == count:
            break
        count = len(signatures)
    reached, order = list(_in_order(table)), dict[int, int]()
    for state in reached:
        order.setdefault(classes[state], len(order))
    arcs_of: list[dict[str, int]] = [{} for _ in order]
    for state in reached:
        arcs_of[order[classes[state]]] = {
            word: order[classes[target]] for word, target in table[state].items()
        }
    ends = frozenset(order[classes[state]] for state in finals if classes[state] in order)
    return WordNetwork(tuple(arcs_of), ends)


def _useful(table: _Table, finals: set[int]) -> set[int]:
    """Compute the states from which a final one is reachable."""
    sources: dict[int, set[int]] = {}
    for state, arcs in enumerate(table):
        for target in arcs.values():
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
        for target in table[state].values():
            if target not in seen:
                seen.add(target)
                todo.append(target)
