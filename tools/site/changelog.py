# SPDX-License-Identifier: Apache-2.0
"""Anchors for the versions of the changelog, which links to a release can use."""

from __future__ import annotations

import re

__all__ = ['with_anchors']

_HEADING = re.compile(r'^\n(?P<marks>###?) (?P<title>.+)$', flags=re.MULTILINE)
_VERSION = re.compile(r'\[?v?(?P<number>\d+(?:\.\d+)+[\w.+-]*)\]?')


def with_anchors(text: str) -> str:
    """
    Name the headings of a changelog for links, in the blank lines above them.

    A version such as `## [1.2.0] - 2026-12-01` gets the anchor `v1-2-0`, and `### Added` below it
    `v1-2-0-added`. The anchors that the site makes by itself would be numbers, which change with
    each release.

    Parameters
    ----------
    text
        The changelog in Markdown, in the format of Keep a Changelog.

    Returns
    -------
    str
        The changelog for the site, with the same number of lines.

    """
    version = ''

    def named(match: re.Match[str]) -> str:
        nonlocal version
        heading = f'{match["marks"]} {match["title"]}'
        if match['marks'] == '##':
            number = _VERSION.match(match['title'])
            version = _slug(f'v{number["number"]}' if number else match['title'])
            # A title that is a word has this anchor already.
            return f'({version})=\n{heading}' if number else match[0]
        return f'({version}-{_slug(match["title"])})=\n{heading}'

    return _HEADING.sub(named, text)


def _slug(title: str) -> str:
    """Return the name of an anchor: what is no letter or digit becomes a hyphen."""
    return re.sub(r'[^a-z0-9]+', '-', title.lower()).strip('-')
