# SPDX-License-Identifier: Apache-2.0
"""Suggestions for a misspelt name."""

from __future__ import annotations

from collections.abc import Iterable


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """
    Return a question that names the closest known name, or '' if none is close.

    Parameters
    ----------
    name
        The name that was not found.
    known
        The existing names.

    """
    found = closest_name(name, known)
    return f'Did you mean {found!r}?' if found else ''


def closest_name(name: str, known: Iterable[str]) -> str:
    """
    Return the closest known name, or '' if none is close.

    Parameters
    ----------
    name
        The name that was not found.
    known
        The existing names.

    """
    from difflib import get_close_matches

    matches = get_close_matches(name, list(known), n=1)
    return matches[0] if matches else ''
