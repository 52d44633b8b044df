# SPDX-License-Identifier: Apache-2.0
"""Suggestions for misspelt names, and lists of known names for messages."""

from __future__ import annotations

from collections.abc import Iterable

_MAX_LISTED = 12


def closest_name(
    name: str, known: Iterable[str], cutoff: float = 0.6, *, ignore_case: bool = False
) -> str:
    """
    Find the known name that is most similar to a misspelt one.

    Parameters
    ----------
    name
        The name as it was written.
    known
        The names that exist.
    cutoff
        The least similarity, from 0 to 1, as in `difflib`; 0.75 suits names that are like each
        other, such as those of joints.
    ignore_case
        Whether capitals and small letters are the same.

    Returns
    -------
    str
        The name, or '' if none is similar enough.

    """
    from difflib import get_close_matches

    by_key = {each.lower() if ignore_case else each: each for each in known}
    key = name.lower() if ignore_case else name
    close = get_close_matches(key, list(by_key), n=1, cutoff=cutoff)
    return by_key[close[0]] if close else ''


def did_you_mean(
    name: str, known: Iterable[str], cutoff: float = 0.6, *, ignore_case: bool = False
) -> str:
    """
    Suggest the known name that is most similar to a misspelt one.

    Parameters
    ----------
    name, known, cutoff, ignore_case
        As for `closest_name`.

    Returns
    -------
    str
        "Did you mean '...'?", or '' if no name is similar enough.

    """
    close = closest_name(name, known, cutoff, ignore_case=ignore_case)
    return f"Did you mean '{close}'?" if close else ''


def listing(names: list[str]) -> str:
    """
    Join names with commas; those after the twelfth are only counted.

    Parameters
    ----------
    names
        The names, in their order.

    """
    more = len(names) - _MAX_LISTED
    return ', '.join(names[:_MAX_LISTED]) + (f' and {more} more' if more > 0 else '')
