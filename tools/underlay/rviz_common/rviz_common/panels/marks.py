# SPDX-License-Identifier: Apache-2.0
"""How levels and texts look in the page."""

from __future__ import annotations

import re

from rviz_common.status import Level, Statuses

__all__ = ['MARKS', 'escaped', 'printable', 'status_text']

MARKS = {Level.OK: '✔', Level.WARN: '⚠', Level.ERROR: '✖'}
SPECIAL = re.compile(r'([\\`*_{}\[\]<>#|~])')
LONGEST = 500


def printable(text: str) -> str:
    """Return a text that can be sent; names of files may have bytes that are no letters."""
    return text.encode(errors='replace').decode()


def escaped(text: str) -> str:
    """Return a text in which nothing means anything to Markdown."""
    text = printable(text)
    if len(text) > LONGEST:
        text = f'{text[:LONGEST]} ...'
    return SPECIAL.sub(r'\\\1', text).replace('\n', ' ')


def status_text(status: Statuses) -> str:
    """Return what a display has to say, as Markdown."""
    return '\n\n'.join(
        f'{MARKS[level]} **{escaped(subject)}**: {escaped(sentence)}'
        for subject, level, sentence in status.items()
    )
