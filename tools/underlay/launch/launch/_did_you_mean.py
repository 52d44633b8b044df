# SPDX-License-Identifier: Apache-2.0
"""Suggestions for a misspelt name."""

from __future__ import annotations

from collections.abc import Iterable


def closest_name(name: str, known: Iterable[str]) -> str:
    """Return what comes closest, or '' if nothing is close."""
    import difflib

    close = difflib.get_close_matches(name, list(known), n=1)
    return close[0] if close else ''


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """Return a question that names what comes closest, or '' if nothing is close."""
    close = closest_name(name, known)
    return f"Did you mean '{close}'?" if close else ''
