# SPDX-License-Identifier: Apache-2.0
"""The navigation of the site, which the tables of docs/README.md define."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
import posixpath
import re

__all__ = ['Group', 'SiteError', 'groups', 'require_all']

_ROW = re.compile(r'^\| \[[^\]]+\]\((?P<page>[^)]+\.md)\) \|', flags=re.MULTILINE)


class SiteError(Exception):
    """An error in the pages; its message says what to do."""


@dataclass(frozen=True)
class Group:
    """A group of pages in the navigation, in the order in which readers need them.

    title: its caption; pages: relative to the workspace, as in `docs/how-to/bags.md`.
    """

    title: str
    pages: tuple[str, ...]


def groups(contents: str) -> list[Group]:
    """
    Parse the groups of pages: each heading of the second level, and the links in its table.

    Parameters
    ----------
    contents
        The text of docs/README.md. Of a heading such as `How-to: do one thing`, the part before
        the colon is the title of the group.

    """
    found = []
    for section in re.split(r'^## ', contents, flags=re.MULTILINE)[1:]:
        title = section.splitlines()[0].partition(':')[0]
        pages = [posixpath.join('docs', each) for each in _ROW.findall(section)]
        found.append(Group(title, tuple(pages)))
    return found


def require_all(found: Iterable[Group], pages: Iterable[str]) -> None:
    """
    Check that the navigation has every page of docs, once.

    Parameters
    ----------
    found
        The groups of the navigation.
    pages
        The pages of docs, relative to the workspace.

    Raises
    ------
    SiteError
        A page is missing, listed twice, or does not exist; the message names each.

    """
    listed = [page for group in found for page in group.pages]
    existing = {*pages} - {'docs/README.md'}
    problems = [
        f'{page} is in no table of docs/README.md, which is the navigation of the site: add a row '
        'with a link to it, where readers need it'
        for page in sorted(existing - {*listed})
    ]
    problems += [
        f'docs/README.md links to {page}, which does not exist: correct or delete its row'
        for page in sorted({*listed} - existing)
    ]
    problems += [
        f'docs/README.md lists {page} more than once: keep one row'
        for page in sorted({page for page in listed if listed.count(page) > 1})
    ]
    if problems:
        raise SiteError('\n'.join(problems))
