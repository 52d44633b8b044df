# SPDX-License-Identifier: Apache-2.0
"""Suggestions for a misspelt name."""

from __future__ import annotations

from collections.abc import Iterable

__all__ = ['closest', 'did_you_mean']


def closest(name: str, known: Iterable[str]) -> str | None:
    """Return the name that comes closest, if any is close."""
    from difflib import get_close_matches

    close = get_close_matches(name, list(known), n=1, cutoff=0.75)
    return close[0] if close else None


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """Return a question, with a space before it, that names what comes closest; or ''."""
    meant = closest(name, known)
    return f" Did you mean '{meant}'?" if meant else ''
