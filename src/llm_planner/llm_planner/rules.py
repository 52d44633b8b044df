# SPDX-License-Identifier: Apache-2.0
"""
Parse English commands with the phrases of the skills, without a language model.

A sentence is understood as a whole or not at all: each of its clauses has to match a phrase of a
skill, and the error message quotes the part that was not understood.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
import difflib
from typing import Any

from humanoid_common.naming import shortened
from llm_planner.clauses import ClauseSearch, joints, skipped
from llm_planner.dialogue import answer_to, AskFirstError, Dialogue, Question, Refusal
from llm_planner.examples import worlds_examples
from llm_planner.grammar import Bindings, Grammar, tokenized
from llm_planner.phrases import Choice, part_of, Phrase, Series, Word
from llm_planner.plan import check, Plan, PlanError
from llm_planner.reading import Clause, Reading
from llm_planner.skills import Saying, Skill, Skills
from llm_planner.world import ANYTHING, in_words, listed, ObjectDescription, spoken_places, World

__all__ = ['RulePlanner']

_LONGEST = 500
_REPAIRED_FROM = 4
"""The spelling of shorter words is not corrected."""
_CLOSE = 0.8
_WITHOUT_JOINT = 0.01
"""The weight of the next clause without `and` or the like, for a speech recogniser."""
_OPEN = ('place', 'class', 'classes')
"""Slots of names; if a sentence matches except for a name, that name is reported as unknown."""
_PLACES = ('place', 'inside', 'surface', 'room')
"""Lists of places: all, those that things are put into, those that they are put onto, rooms. What
is typed may be any place, and a speech recogniser expects only the likely ones."""
_NAMES = (*_OPEN, *_PLACES[1:])
"""Lists of names."""


class RulePlanner:
    """
    Rule-based planner that parses commands into plans.

    Parameters
    ----------
    skills
        The skills, with the phrases that ask for them.

    """

    def __init__(self, skills: Skills) -> None:
        self.skills = skills
        self._grammars: dict[Any, tuple[Grammar, Grammar, frozenset[str]]] = {}
        self._sayings = [(skill, saying) for skill in skills for saying in skill.sayings]

    def plan(self, text: str, world: World, dialogue: Dialogue) -> Plan | Question | Refusal:
        """
        Parse a command into a plan, a question or a refusal.

        Parameters
        ----------
        text
            The command, as spoken or typed; it may answer the question of the dialogue.
        world
            The current state of the world.
        dialogue
            The dialogue context; it is updated.

        """
        if len(text) > _LONGEST:
            return Refusal(f'That is too long for me: say it in at most {_LONGEST} characters.')
        tokens = tokenized(text)
        if not tokens:
            return Refusal('I heard no words. Say, for instance, "go to the kitchen".')
        question, dialogue.question = dialogue.question, None
        answer = answer_to(tokens, question) if question is not None else None
        if question is None or answer is None or question.is_yes_or_no:
            dialogue.chosen.clear()
        if question is not None and answer == 'no':
            return Refusal('All right, I will leave it.')
        if question is not None and answer is not None:
            if isinstance(question.subject, Plan):
                return self._confirmed(question.subject, world)
            dialogue.chosen[question.subject] = question.choices[answer]
            text, tokens = question.command, tokenized(question.command)
        try:
            clauses = self._clauses(tokens, world)
            plan = self._interpreted(text, clauses, world, dialogue)
            check(plan, self.skills, world)
        except AskFirstError as error:
            dialogue.question = error.question
            return error.question
        except PlanError as error:
            return Refusal(str(error))
        return plan

    def _confirmed(self, plan: Plan, world: World) -> Plan | Refusal:
        """Return a confirmed plan if it is still valid, else the reason."""
        try:
            check(plan, self.skills, world)
        except PlanError as error:
            return Refusal(str(error))
        return plan

    def object_of(self, text: str, world: World) -> ObjectDescription:
        """
        Parse the description of an object: `the red mug on the desk`.

        Parameters
        ----------
        text
            The description; a pronoun is not accepted.
        world
            The state of the world, which has the names of places.

        Raises
        ------
        PlanError
            The text describes no object, or several places fit.

        """
        grammar, _, _ = self._grammar(world)
        tokens = tokenized(text)
        for end, bindings in grammar.matches(grammar.rules['object'], tokens):
            if end == len(tokens) and not dict(bindings).get('pronoun'):
                return Reading(self.skills, world, Dialogue()).described_object(bindings)
        raise PlanError(f"I do not know what '{shortened(text)}' is.")

    def to_jsgf(self, world: World) -> str:
        """
        Export the grammar of all commands for a speech recogniser, in JSGF.

        Parameters
        ----------
        world
            The state of the world, with the places that can be named.

        Returns
        -------
        str
            A grammar in JSGF 1.0 with the public rule `<command>`, and with examples of commands.

        """
        grammar, _, _ = self._grammar(world)
        phrases: dict[str, Phrase] = {}
        for number, (skill, saying) in enumerate(self._sayings):
            phrases[f'{skill.name}_phrase_{number}'] = saying.phrase
        probe = grammar.to_jsgf('robot', '<VOID>', phrases)
        usable = [name for name in phrases if f'\n<{name}> = ' in probe]
        clause = f'({" | ".join(f"<{name}>" for name in usable)})'
        joint = f'(<joint> | /{_WITHOUT_JOINT:g}/ <NULL>)'
        command = f'<beginning>* {clause} ({joint} {clause})* <end>*'
        examples = worlds_examples(self.skills, [in_words(name) for name in world.place_names])
        return grammar.to_jsgf('robot', command, phrases, examples)

    def is_stop(self, text: str) -> bool:
        """
        Check whether a sentence only tells the robot to stop, once or repeatedly.

        Parameters
        ----------
        text
            The sentence, as spoken or typed.

        """
        grammar, _, _ = self._grammar(World())
        tokens = [each for each in tokenized(text) if each != ',']
        sayings = self.skills['stop'].sayings if 'stop' in self.skills.skills else ()
        begins = set(skipped(grammar, 'beginning', tokens, 0))
        ends: set[int] = set()
        while begins:
            begin = begins.pop()
            found = {
                end
                for saying in sayings
                for end, _ in grammar.matches(saying.phrase, tokens, begin)
            }
            begins |= found - ends
            ends |= found
        return any(len(tokens) in skipped(grammar, 'end', tokens, end) for end in ends)

    def _grammar(self, world: World) -> tuple[Grammar, Grammar, frozenset[str]]:
        """Return the grammar of a world, one that accepts any words as names, and all words."""
        key = (tuple(world.places), world.rooms, world.containers)
        if key not in self._grammars:
            vocabulary = self.skills.vocabulary
            lists: dict[str, Mapping[str, Any]] = {
                name: {word: value for value, words in values.items() for word in words}
                for name, values in vocabulary.items()
                if name != 'place'
            }
            places = spoken_places(world, vocabulary.get('place', {}))
            lists |= dict.fromkeys(_PLACES, places)
            numbers, texts = {}, set()
            for skill in self.skills:
                for argument in skill.arguments.values():
                    slot = f'{skill.name}_{argument.name}'
                    if argument.kind == 'choice':
                        lists[slot] = {
                            word: value for value, ws in argument.values.items() for word in ws
                        }
                    elif argument.kind == 'number':
                        numbers[slot] = argument.unit
                    elif argument.kind == 'text':
                        texts.add(slot)
            rules = self.skills.rules
            spoken = {kind: _texts_of(kind, places, world) for kind in _PLACES}
            weights = self.skills.weights
            exact = Grammar(rules, lists, numbers, frozenset(texts), spoken, weights)
            closed = {name: each for name, each in lists.items() if name not in _NAMES}
            loose = Grammar(rules, closed, numbers, frozenset((*texts, *_NAMES)))
            self._grammars[key] = exact, loose, _all_words(exact, self._sayings)
        return self._grammars[key]

    def _clauses(self, tokens: list[str], world: World) -> list[Clause]:
        """Parse a sentence into clauses; ask if that needs a correction of the spelling."""
        grammar, loose, words = self._grammar(world)
        search = ClauseSearch(grammar, self._sayings, tokens)
        found, furthest = search.first(), search.furthest
        found = found or search.first(needs_joint=False)
        if found is not None:
            return found
        mended = [_mended(each, words) for each in tokens]
        search = ClauseSearch(grammar, self._sayings, mended)
        if mended != tokens and (search.first() or search.first(needs_joint=False)):
            meant = ' '.join(mended).replace(' ,', ',')
            raise AskFirstError(Question(f'Did you mean "{meant}"?', meant, None, {'yes': meant}))
        for clause in ClauseSearch(loose, self._sayings, tokens).first(furthest) or ():
            _refuse_unknown_names(clause.bindings, grammar, words, world)
        raise PlanError(self._not_understood(grammar, tokens, furthest))

    def _not_understood(self, grammar: Grammar, tokens: list[str], at: int) -> str:
        """Build the message that quotes the clause not understood, with a hint on what to say."""
        end = next(
            (
                index
                for index in range(at + 1, len(tokens))
                if any(True for _ in joints(grammar, tokens, index))
            ),
            len(tokens),
        )
        quoted = shortened(' '.join(each for each in tokens[at:end] if each != ','))
        examples = {
            skill.name: skill.name.replace('_', ' ')
            for skill, saying in self._sayings
            if any(isinstance(p, Word) and p.text == tokens[at] for p in _first_words(saying))
        }
        hint = (
            f'I can {listed(list(examples.values()))}, but not like that.'
            if examples
            else 'You can say, for instance: "go to the kitchen", "find the red mug" or "what do '
            'you see".'
        )
        return f'I did not understand "{quoted}". {hint}'

    def _interpreted(
        self, text: str, clauses: Sequence[Clause], world: World, dialogue: Dialogue
    ) -> Plan:
        """Build the plan that the clauses ask for, and update the dialogue."""
        reading = Reading(self.skills, world, dialogue)
        for clause in clauses:
            reading.read(clause, text)
        dialogue.last_object, dialogue.last_place = reading.last_object, reading.last_place
        return Plan(text, tuple(reading.steps))


def _texts_of(kind: str, places: Mapping[str, Sequence[str]], world: World) -> list[str]:
    """Return the spoken texts that can mean a place of a kind, one of `_PLACES`."""
    meant: Mapping[str, Collection[str]] = {
        'place': world.place_names,
        'inside': (*world.containers, *world.rooms),
        'surface': {*world.places} - {*world.containers},
        'room': world.rooms,
    }
    return [text for text, names in places.items() if not {*names}.isdisjoint(meant[kind])]


def _mended(token: str, words: frozenset[str]) -> str:
    """Correct the spelling of an unknown word to a similar known one, if there is one."""
    if token in words or len(token) < _REPAIRED_FROM or not token.isalpha():
        return token
    close = difflib.get_close_matches(token, words, 1, _CLOSE)
    return close[0] if close else token


def _all_words(grammar: Grammar, sayings: Sequence[tuple[Skill, Saying]]) -> frozenset[str]:
    phrases = [*grammar.rules.values(), *(saying.phrase for _, saying in sayings)]
    words = {part.text for phrase in phrases for part in part_of(phrase) if isinstance(part, Word)}
    for values in grammar.lists.values():
        words.update(word for text in values for word in tokenized(text))
    return frozenset(words)


def _first_words(saying: Saying) -> Iterator[Phrase]:
    """Yield the possible first words of a phrase."""
    pending: list[Phrase] = [saying.phrase]
    while pending:
        phrase = pending.pop()
        if isinstance(phrase, Word):
            yield phrase
        elif isinstance(phrase, Choice):
            pending.extend(phrase.parts)
        elif isinstance(phrase, Series):
            pending.append(phrase.parts[0])


def _refuse_unknown_names(
    bindings: Bindings, grammar: Grammar, words: frozenset[str], world: World
) -> None:
    """Raise PlanError for the first name without any known word."""
    for name, value in bindings:
        if isinstance(value, tuple):
            _refuse_unknown_names(value, grammar, words, world)
        elif name not in _OPEN or {*value.split()} & words:
            continue
        elif name == 'place':
            rooms = [in_words(each) for each in (*world.rooms, *world.places)]
            known = f'I know {listed(rooms)}.' if rooms else 'I do not know any places.'
            raise PlanError(f'I do not know a place called "{shortened(value)}". {known}')
        else:
            known = listed(sorted({*grammar.lists['class'].values()} - {ANYTHING}))
            raise PlanError(
                f'I do not know what "{shortened(value)}" is. I can recognise: {known}.'
            )
