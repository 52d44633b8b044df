# SPDX-License-Identifier: Apache-2.0
"""Suggestions for a misspelt name."""

from __future__ import annotations

from collections.abc import Iterable


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """Return a question that names the closest known name, or '' if none is close."""
    from difflib import get_close_matches

    matches = get_close_matches(name, list(known), n=1)
    return f'Did you mean {matches[0]!r}?' if matches else ''
