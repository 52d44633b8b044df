# SPDX-License-Identifier: Apache-2.0
"""What the head of a source file says about copyright and licence."""

from __future__ import annotations

from dataclasses import dataclass
import re

COMMENT = re.compile(r'^\s*(#|//|/\*|\*|"""|\'\'\'|$)')
HOLDER = re.compile(
    r'(?:copyright\s*(?:\(c\)|©)?\s*[:,]?\s*\d{4}|SPDX-FileCopyrightText:)', re.IGNORECASE
)
LICENCE = re.compile(
    r'SPDX-License-Identifier:|permission is hereby granted|redistribution and use|licen[sc]e',
    re.IGNORECASE,
)


@dataclass(frozen=True)
class Header:
    """Whether a file's head names a holder of the copyright and a licence."""

    has_holder: bool
    has_licence: bool

    @property
    def defect(self) -> str:
        """Say what is missing; empty where nothing is."""
        if not self.has_holder:
            return 'could not find copyright notice'
        return '' if self.has_licence else 'could not find the licence that the file is under'


def read_header(text: str) -> Header:
    """
    Read the comments before the first statement of a source text.

    Parameters
    ----------
    text
        The source text, in Python, C or C++.

    """
    head = []
    for line in text.splitlines():
        if not COMMENT.match(line):
            break
        head.append(line)
    comments = '\n'.join(head)
    return Header(bool(HOLDER.search(comments)), bool(LICENCE.search(comments)))
