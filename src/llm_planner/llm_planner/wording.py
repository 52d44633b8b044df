# SPDX-License-Identifier: Apache-2.0
"""Natural-language wording of objects."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

from llm_planner.world import ANYTHING, in_words, KnownObject, listed, ObjectDescription

__all__ = ['NUMBERS', 'capital', 'enumerated', 'where_is', 'with_article']

NUMBERS = ('no', 'one', 'two', 'three', 'four', 'five', 'six', 'seven', 'eight', 'nine', 'ten')


def where_is(thing: KnownObject) -> str:
    """
    Describe where an object is, in words that follow its name.

    Parameters
    ----------
    thing
        The object.

    Returns
    -------
    str
        ` on the desk` or ` in the hall`; empty if neither surface nor room is known.

    """
    on = f' on the {in_words(thing.place)}' if thing.place else ''
    return on or (f' in the {in_words(thing.room)}' if thing.room else '')


def with_article(name: str) -> str:
    """
    Put the indefinite article before a name: an apple.

    Parameters
    ----------
    name
        Such as `apple` or `red mug`.

    """
    return f'{"an" if name[:1] in "aeiou" else "a"} {name}'


def capital(text: str) -> str:
    """
    Capitalise the first letter of a text.

    Parameters
    ----------
    text
        The text; the rest of it stays as it is.

    """
    return text[:1].upper() + text[1:]


def enumerated(things: Sequence[KnownObject]) -> str:
    """
    List objects in words: a red mug and two books.

    Parameters
    ----------
    things
        The objects; those with the same name are counted.

    Returns
    -------
    str
        The list; empty for no objects.

    """
    counts: Mapping[str, int] = Counter(each.name or ANYTHING for each in things)
    names = []
    for name, count in counts.items():
        colour, _, class_id = name.rpartition(' ')
        several = ObjectDescription(class_id, colour).plural_text
        number = NUMBERS[count] if count < len(NUMBERS) else str(count)
        names.append(with_article(name) if count == 1 else f'{number} {several}')
    return listed(names)
