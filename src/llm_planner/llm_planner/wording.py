# SPDX-License-Identifier: Apache-2.0
"""How people speak of things."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

from llm_planner.world import ANYTHING, in_words, listed, ObjectDescription, Thing

__all__ = ['NUMBERS', 'capital', 'enumerated', 'where_is', 'with_article']

NUMBERS = ('no', 'one', 'two', 'three', 'four', 'five', 'six', 'seven', 'eight', 'nine', 'ten')


def where_is(thing: Thing) -> str:
    """Return where a thing is, in words that follow others; empty if that has no name."""
    on = f' on the {in_words(thing.place)}' if thing.place else ''
    return on or (f' in the {in_words(thing.room)}' if thing.room else '')


def with_article(name: str) -> str:
    """Return a name with its article: an apple."""
    return f'{"an" if name[:1] in "aeiou" else "a"} {name}'


def capital(text: str) -> str:
    """Return a text that begins with a capital letter."""
    return text[:1].upper() + text[1:]


def enumerated(things: Sequence[Thing]) -> str:
    """Return things as people list them: a red mug and two books; empty for none."""
    counts: Mapping[str, int] = Counter(each.name or ANYTHING for each in things)
    names = []
    for name, count in counts.items():
        colour, _, class_id = name.rpartition(' ')
        several = ObjectDescription(class_id, colour).plural_text
        number = NUMBERS[count] if count < len(NUMBERS) else str(count)
        names.append(with_article(name) if count == 1 else f'{number} {several}')
    return listed(names)
