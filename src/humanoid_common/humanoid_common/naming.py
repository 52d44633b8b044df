# SPDX-License-Identifier: Apache-2.0
"""Find the name that was meant."""

from __future__ import annotations

from collections.abc import Iterable
import difflib

_LONGEST = 80


def did_you_mean(name: str, candidates: Iterable[str]) -> str:
    """Return a question that names the closest candidate, or '' when none is close."""
    matches = difflib.get_close_matches(name, list(candidates), n=1)
    return f"Did you mean '{matches[0]}'?" if matches else ''


def shortened(name: str) -> str:
    """Return a name as a message can show it: the beginning of one that is endless."""
    return name if len(name) <= _LONGEST else f'{name[:_LONGEST]}...'
