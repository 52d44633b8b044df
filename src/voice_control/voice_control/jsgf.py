# SPDX-License-Identifier: Apache-2.0
"""
Compile a JSGF grammar into a minimal word network that a decoder can search.

pocketsphinx can read JSGF itself, but it expands each reference to a rule separately, so that a
grammar of sixty commands about objects takes longer to search than to say. Here the grammar
becomes a nondeterministic automaton (Thompson's construction; see Hopcroft, Motwani and Ullman,
Introduction to Automata Theory, chapter 3), and then a minimal deterministic one. Words that
cannot be pronounced are left out on the way, with everything that requires them.

JSGF: https://www.w3.org/TR/jsgf/. A weight multiplies how likely the first words of its
alternative are; all words that can come next are equally likely otherwise. Tags are ignored;
imports and recursive rules are rejected.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
import math
import re

from voice_control.recognition import RecognizerError
from voice_control.word_network import minimal_network, Moves, WordNetwork

__all__ = ['compile_jsgf']

_TOKEN = re.compile(
    r'<[^<>]*>|"[^"]*"|/[\d.eE+-]+/|\{(?:[^{}\\]|\\.)*\}|[()\[\]|=;*+]|[^\s()\[\]|=;*+<>"/{}]+'
)
_COMMENT = re.compile(r'//[^\n]*|/\*.*?\*/', re.DOTALL)
_DOCUMENTATION = re.compile(r'/\*\*.*?\*/', re.DOTALL)
_EXAMPLE = re.compile(r'@example\s+([^\n*]+)')
_HEADER = re.compile(r'\s*#JSGF\b[^;]*;\s*grammar\s+[\w.]+\s*;', re.DOTALL)
_MOST_STATES = 200_000


def compile_jsgf(jsgf: str, is_known: Callable[[str], bool] = lambda _: True) -> WordNetwork:
    """
    Compile the public rule of a grammar.

    Parameters
    ----------
    jsgf
        A grammar in JSGF 1.0 with at least one public rule; the first one is compiled.
    is_known
        Returns whether a word can be pronounced; other words are left out.

    Returns
    -------
    WordNetwork
        The network.

    Raises
    ------
    RecognizerError
        If the grammar is invalid, or accepts no sentence.

    """
    rules, public = _read(jsgf)
    compiler = _Compiler(rules, is_known)
    network = compiler.network(public)
    if not network.finals:
        raise RecognizerError('The grammar accepts no sentence.')
    found = replace(network, unknown=tuple(compiler.unknown))
    documentation = ' '.join(_DOCUMENTATION.findall(jsgf))
    examples = [' '.join(each.split()) for each in _EXAMPLE.findall(documentation)]
    return replace(found, shown=tuple(each for each in examples if found.accepts(each)))


def _read(jsgf: str) -> tuple[dict[str, list[str]], str]:
    """Tokenise the rules, by their names in angle brackets; also return the public one."""
    text = _COMMENT.sub(' ', jsgf)
    header = _HEADER.match(text)
    if header is None:
        raise RecognizerError('A grammar has to start with "#JSGF V1.0; grammar NAME;".')
    tokens = _TOKEN.findall(text, header.end())
    rules: dict[str, list[str]] = {}
    public = ''
    statement: list[str] = []
    for token in tokens:
        if token != ';':
            statement.append(token)
            continue
        is_public = statement[:1] == ['public']
        name, equals, *body = [*statement[is_public:], '', ''][: len(statement) - is_public + 2]
        if equals != '=' or not name.startswith('<'):
            raise RecognizerError(
                f'"{" ".join(statement)[:60]}" is not a rule such as "<a> = b;".'
            )
        rules[name] = [each for each in body if each and each[0] != '{']
        public = public or (name if is_public else '')
        statement = []
    if statement:
        raise RecognizerError(f'The rule "{" ".join(statement)[:60]}" has no end (";").')
    if not public:
        raise RecognizerError('The grammar has no public rule.')
    return rules, public


@dataclass
class _Compiler:
    """Compiler of the rules of a grammar, each once: references copy its network."""

    rules: Mapping[str, list[str]]
    is_known: Callable[[str], bool]
    unknown: dict[str, None] = field(default_factory=dict)
    _compiled: dict[str, WordNetwork] = field(default_factory=dict)
    _open: list[str] = field(default_factory=list)

    def network(self, rule: str) -> WordNetwork:
        """Compile a rule to its minimal network, or return the cached one."""
        if rule not in self.rules:
            raise RecognizerError(f'The rule {rule} is used, but not defined.')
        if rule in self._open:
            raise RecognizerError(f'The rule {rule} refers to itself; use * or + instead.')
        if rule not in self._compiled:
            self._open.append(rule)
            automaton = _Automaton(self, rule)
            tokens = self.rules[rule]
            first, last, end = automaton.alternatives(tokens, 0)
            if end != len(tokens):
                raise RecognizerError(f'The rule {rule} has an unmatched "{tokens[end]}".')
            self._compiled[rule] = minimal_network(automaton.moves, first, last)
            self._open.pop()
        return self._compiled[rule]


@dataclass
class _Automaton:
    """A nondeterministic finite automaton with epsilon moves, built from the tokens of a rule."""

    compiler: _Compiler
    rule: str
    moves: Moves = field(default_factory=list)
    """For each state, words with target states and weights; an empty word is an epsilon move."""

    def _copy(self, network: WordNetwork) -> tuple[int, int]:
        """Add a copy of the states of another rule; return the first and the last one."""
        states = [self._state() for _ in network.arcs]
        last = self._state()
        for state, arcs, weights in zip(states, network.arcs, network.weights, strict=True):
            self.moves[state] = [
                (word, states[target], weights[word]) for word, target in arcs.items()
            ]
        for state, weight in network.ends.items():
            self.moves[states[state]].append(('', last, weight))
        return states[0], last

    def _state(self) -> int:
        if len(self.moves) >= _MOST_STATES:
            raise RecognizerError('The grammar is too large.')
        self.moves.append([])
        return len(self.moves) - 1

    def alternatives(self, tokens: list[str], at: int) -> tuple[int, int, int]:
        """Parse up to a closing bracket or the end; return first and last state, and its index."""
        first, last = self._state(), self._state()
        while True:
            weight = 1.0
            if at < len(tokens) and tokens[at][0] == '/':
                weight = self._weight(tokens[at])
                at += 1
            begin, end, at = self._sequence(tokens, at)
            self._go(first, begin, weight)
            self._go(end, last)
            if at == len(tokens) or tokens[at] != '|':
                return first, last, at
            at += 1

    def _go(self, source: int, target: int, weight: float = 1.0) -> None:
        """Add an epsilon move."""
        self.moves[source].append(('', target, weight))

    def _weight(self, token: str) -> float:
        try:
            weight = float(token.strip('/'))
        except ValueError:
            weight = 0.0
        if not 0.0 < weight < math.inf:
            raise RecognizerError(
                f'The weight {token} in {self.rule} is not a positive number such as /2/.'
            )
        return weight

    def _sequence(self, tokens: list[str], at: int) -> tuple[int, int, int]:
        first = last = self._state()
        count = 0
        while at < len(tokens) and tokens[at] not in ('|', ')', ']'):
            begin, end, at = self._item(tokens, at)
            self._go(last, begin)
            last = end
            count += 1
        if not count:
            raise RecognizerError(f'An alternative of {self.rule} is empty: use <NULL>.')
        return first, last, at

    def _item(self, tokens: list[str], at: int) -> tuple[int, int, int]:
        """Parse a word, a rule or a group, with repetition operators behind it: * or +."""
        token = tokens[at]
        at += 1
        if token in ('(', '['):
            first, last, at = self.alternatives(tokens, at)
            if at == len(tokens) or tokens[at] != {'(': ')', '[': ']'}[token]:
                raise RecognizerError(f'A "{token}" in {self.rule} is not closed.')
            at += 1
            if token == '[':
                self._go(first, last)
        elif token in ('*', '+', '=', ')', ']') or token[0] == '/':
            raise RecognizerError(f'A "{token}" in {self.rule} is out of place.')
        elif token.startswith('<'):
            first, last = self._reference(token)
        else:
            first, last = self._words(token.strip('"').lower().split())
        while at < len(tokens) and tokens[at] in ('*', '+'):
            begin, end = self._state(), self._state()
            self._go(begin, first)
            self._go(last, first)
            self._go(last, end)
            if tokens[at] == '*':
                self._go(begin, end)
            first, last, at = begin, end, at + 1
        return first, last, at

    def _reference(self, rule: str) -> tuple[int, int]:
        if rule == '<NULL>':
            state = self._state()
            return state, state
        if rule == '<VOID>':
            return self._state(), self._state()
        return self._copy(self.compiler.network(rule))

    def _words(self, words: list[str]) -> tuple[int, int]:
        first = last = self._state()
        for word in words:
            following = self._state()
            if self.compiler.is_known(word):
                self.moves[last].append((word, following, 1.0))
            else:
                self.compiler.unknown[word] = None
            last = following
        return first, last
