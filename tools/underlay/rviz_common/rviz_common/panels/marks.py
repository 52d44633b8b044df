# SPDX-License-Identifier: Apache-2.0
"""Formatting of status levels and texts for the page."""

from __future__ import annotations

import re

from rviz_common.status import Level, Statuses

__all__ = ['MARKS', 'escaped', 'printable', 'status_text']

MARKS = {Level.OK: '✔', Level.WARN: '⚠', Level.ERROR: '✖'}
SPECIAL = re.compile(r'([\\`*_{}\[\]<>#|~])')
LONGEST = 500


def printable(text: str) -> str:
    """
    Replace characters that cannot be encoded as UTF-8: file names may have undecodable bytes.

    Parameters
    ----------
    text
        Any text.

    """
    return text.encode(errors='replace').decode()


def escaped(text: str) -> str:
    """
    Escape a text for Markdown, as one line.

    Parameters
    ----------
    text
        Any text; only the first 500 characters are kept.

    """
    text = printable(text)
    if len(text) > LONGEST:
        text = f'{text[:LONGEST]} ...'
    return SPECIAL.sub(r'\\\1', text).replace('\n', ' ')


def status_text(status: Statuses) -> str:
    """
    Format the status messages of a display as Markdown, with a paragraph for each subject.

    Parameters
    ----------
    status
        The status of the display.

    """
    return '\n\n'.join(
        f'{MARKS[level]} **{escaped(subject)}**: {escaped(sentence)}'
        for subject, level, sentence in status.items()
    )
