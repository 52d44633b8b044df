# SPDX-License-Identifier: Apache-2.0
"""Where the site shows a file of the workspace; links of pages, checked and rewritten for that."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
import posixpath
import re

from contents import SiteError

__all__ = ['linked_file', 'linked_files', 'require_anchors', 'rewrite_page', 'site_path']

_PLACES = {
    'README.md': 'index.md',
    'docs/README.md': 'all_pages.md',
    'CHANGELOG.md': 'changelog.md',
    'CONTRIBUTING.md': 'contributing.md',
}
_PACKAGE = re.compile(r'(?:src|tools/underlay)/(\w+)/README\.md')
_CODE = re.compile(
    r'^(?P<fence>`{3,}).*?^(?P=fence)$|(?P<ticks>`+)[^`]+(?P=ticks)(?!`)',
    flags=re.MULTILINE | re.DOTALL,
)
_LINK = re.compile(
    r'(?:(?P<start>!?\[)(?P<label>[^\[\]]*))?\]'
    r'\((?P<target>[^()\s#:]+)(?P<anchor>#[^()\s]*)?\)'
)
_ANCHORED = re.compile(r'\]\((?P<target>[^()\s#:]*)#(?P<anchor>[^()\s]+)\)')
_FENCED = re.compile(r'^(?P<fence>`{3,}).*?^(?P=fence)$', flags=re.MULTILINE | re.DOTALL)
_HEADING = re.compile(r'^#{1,4} +(?P<title>.+?) *$', flags=re.MULTILINE)
_WRITTEN_FILE = re.compile(r'^```(\w+) file=(\S+)$', flags=re.MULTILINE)


def site_path(path: str) -> str:
    """
    Return where the site keeps a file of the workspace.

    Parameters
    ----------
    path
        The file, relative to the workspace, as in `docs/how-to/bags.md`.

    Returns
    -------
    str
        The page or picture, relative to the site's sources. Pages of `docs` keep their place, and
        the README of a package is in `packages`. Any other file gets a page with its text.

    """
    if path in _PLACES:
        return _PLACES[path]
    if package := _PACKAGE.fullmatch(path):
        return f'packages/{package[1]}.md'
    if path.startswith('docs/'):
        return path.removeprefix('docs/')
    return f'source/{path}.md'


def linked_files(text: str, page: str) -> Iterator[str]:
    """
    Find the files and folders of the workspace that a page links to.

    Parameters
    ----------
    text
        The page in Markdown.
    page
        Where it is, relative to the workspace.

    Yields
    ------
    str
        Each path, relative to the workspace; one that starts with `..` leaves it.

    """
    for prose, _ in _split(text):
        for match in _LINK.finditer(prose):
            yield _resolve(match['target'], page)


def linked_file(root: Path, page: str, path: str) -> str:
    """
    Return the file that a path names in a link of a page: of a folder, its README.

    Parameters
    ----------
    root
        The workspace.
    page, path
        The page and the path, relative to the workspace.

    Raises
    ------
    SiteError
        There is no such file in the workspace; the message says where the link is.

    """
    readme = posixpath.normpath(posixpath.join(path, 'README.md'))
    for each in (path, readme):
        if not each.startswith('..') and (root / each).is_file():
            return each
    raise SiteError(
        f'{page} links to {path}, which is neither a file of the workspace nor a folder with a '
        'README.md: correct the link'
    )


def require_anchors(pages: Mapping[str, str], file_of: Callable[[str, str], str]) -> None:
    """
    Check that each link to a heading leads to one.

    Parameters
    ----------
    pages
        The text of each page, by its path relative to the workspace. Links to other files are not
        checked.
    file_of
        Returns the file that stands for a path in a link of a page, as `linked_file` does.

    Raises
    ------
    SiteError
        A page has no such heading; the message names each link.

    """
    anchors = {page: _heading_anchors(text) for page, text in pages.items()}
    problems = [
        f'{page} links to #{anchor} of {target}, which has no such heading: correct the link'
        for page, text in pages.items()
        for target, anchor in _linked_anchors(text, page, file_of)
        if anchor not in anchors.get(target, {anchor})
    ]
    if problems:
        raise SiteError('\n'.join(problems))


def _linked_anchors(
    text: str, page: str, file_of: Callable[[str, str], str]
) -> Iterator[tuple[str, str]]:
    """Yield the page and the anchor of each link to a heading."""
    for prose, _ in _split(text):
        for match in _ANCHORED.finditer(prose):
            target = match['target']
            yield file_of(page, _resolve(target, page)) if target else page, match['anchor']


def _heading_anchors(text: str) -> set[str]:
    """Return the anchors that code hosts and the site give to the headings of a page."""
    found: Counter[str] = Counter()
    anchors = set()
    for match in _HEADING.finditer(_FENCED.sub('', text)):
        slug = re.sub(r'[^\w -]', '', match['title'].lower()).replace(' ', '-')
        anchors.add(f'{slug}-{found[slug]}' if found[slug] else slug)
        found[slug] += 1
    return anchors


def rewrite_page(text: str, page: str, file_of: Callable[[str], str]) -> str:
    """
    Rewrite a page for the site: its links, and the blocks that the reader writes to a file.

    Line numbers stay, so that warnings about the result are true of the page. A link whose text is
    the file name of another page gets the title of that page instead.

    Parameters
    ----------
    text
        The page in Markdown.
    page
        Where it is, relative to the workspace.
    file_of
        Returns the file that stands for a linked path, such as the README of a folder. Both are
        relative to the workspace.

    Returns
    -------
    str
        The page for the site.

    """
    folder = posixpath.dirname(site_path(page)) or '.'

    def link(match: re.Match[str]) -> str:
        target = file_of(_resolve(match['target'], page))
        place = posixpath.relpath(site_path(target), folder) + (match['anchor'] or '')
        start, label = match['start'] or '', match['label'] or ''
        if start == '[' and label.endswith('.md') and target.endswith(label):
            return f'*[]({place})*'
        if start == '[' and label == posixpath.basename(target).removesuffix('.md'):
            return f'[]({place})'
        return f'{start}{label}]({place})'

    text = ''.join(_LINK.sub(link, prose) + code for prose, code in _split(text))
    return _WRITTEN_FILE.sub(r'```{written-file} \1 \2', text)


def _split(text: str) -> list[tuple[str, str]]:
    """Split a page into pairs of prose and the code that follows it."""
    pairs = []
    end = 0
    for code in _CODE.finditer(text):
        pairs.append((text[end : code.start()], code.group()))
        end = code.end()
    return [*pairs, (text[end:], '')]


def _resolve(target: str, page: str) -> str:
    """Return the path of a link's target, relative to the workspace."""
    return posixpath.normpath(posixpath.join(posixpath.dirname(page), target))
