# SPDX-License-Identifier: Apache-2.0
"""Suggestions for misspelt names."""

from __future__ import annotations

from collections.abc import Iterable


def closest_name(name: str, known: Iterable[str], cutoff: float = 0.6) -> str:
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

    Returns
    -------
    str
        The name, or '' if none is similar enough.

    """
    from difflib import get_close_matches

    close = get_close_matches(name, list(known), n=1, cutoff=cutoff)
    return close[0] if close else ''


def did_you_mean(name: str, known: Iterable[str], cutoff: float = 0.6) -> str:
    """
    Suggest the known name that is most similar to a misspelt one.

    Parameters
    ----------
    name, known, cutoff
        As for `closest_name`.

    Returns
    -------
    str
        "Did you mean '...'?", or '' if no name is similar enough.

    """
    close = closest_name(name, known, cutoff)
    return f"Did you mean '{close}'?" if close else ''
