# SPDX-License-Identifier: Apache-2.0
"""Suggestions for misspelt names."""

from __future__ import annotations

from collections.abc import Iterable

__all__ = ['closest', 'did_you_mean']


def closest(name: str, known: Iterable[str]) -> str | None:
    """
    Find the known name that is most similar to a misspelt one.

    Parameters
    ----------
    name
        The misspelt name.
    known
        The existing names.

    Returns
    -------
    str or None
        The name; None if no name is similar enough (ratio 0.75 of `difflib`).

    """
    from difflib import get_close_matches

    close = get_close_matches(name, list(known), n=1, cutoff=0.75)
    return close[0] if close else None


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """
    Suggest the known name that is most similar to a misspelt one.

    Parameters
    ----------
    name
        The misspelt name.
    known
        The existing names.

    Returns
    -------
    str
        " Did you mean '...'?", with the leading space, or '' if no name is similar.

    """
    meant = closest(name, known)
    return f" Did you mean '{meant}'?" if meant else ''
