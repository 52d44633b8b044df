# SPDX-License-Identifier: Apache-2.0
"""Suggestions for misspelt names."""

from __future__ import annotations

from collections.abc import Iterable
import difflib

_LONGEST = 80


def did_you_mean(name: str, candidates: Iterable[str]) -> str:
    """
    Suggest the name that is closest to a misspelt one.

    Parameters
    ----------
    name
        The name as it was given.
    candidates
        Names that exist.

    Returns
    -------
    str
        "Did you mean 'x'?", or '' when none is close.

    """
    matches = difflib.get_close_matches(name, list(candidates), n=1)
    return f"Did you mean '{matches[0]}'?" if matches else ''


def shortened(name: str) -> str:
    """
    Truncate a name to 80 characters, for a message.

    Parameters
    ----------
    name
        The name as it was given, of any length.

    """
    return name if len(name) <= _LONGEST else f'{name[:_LONGEST]}...'
