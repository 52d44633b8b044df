# SPDX-License-Identifier: Apache-2.0
"""Suggestions for a misspelt name."""

from __future__ import annotations

from collections.abc import Iterable


def closest_name(name: str, known: Iterable[str]) -> str:
    """
    Find the known name that is closest to a misspelt one.

    Parameters
    ----------
    name
        The name as it was written.
    known
        The names to choose from.

    Returns
    -------
    str
        The closest name, or '' if none is close.

    """
    import difflib

    close = difflib.get_close_matches(name, list(known), n=1)
    return close[0] if close else ''


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """
    Suggest the known name that is closest to a misspelt one.

    Parameters
    ----------
    name, known
        As for `closest_name`.

    Returns
    -------
    str
        A question for the user, or '' if no name is close.

    """
    close = closest_name(name, known)
    return f"Did you mean '{close}'?" if close else ''
