# SPDX-License-Identifier: Apache-2.0
"""The pages of the site: those of docs, READMEs, the Python reference, and what they link to."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import partial
from pathlib import Path, PurePosixPath
import shutil

from changelog import with_anchors
from contents import Group, groups, require_all
from links import linked_file, linked_files, require_anchors, rewrite_page, site_path
from own_packages import is_own_package
from python_reference import python_page

__all__ = ['write_pages']

_PICTURES = ('.gif', '.jpg', '.png', '.svg', '.webp')
_LANGUAGES = {
    '.html': 'html',
    '.py': 'python',
    '.rviz': 'yaml',
    '.toml': 'toml',
    '.xacro': 'xml',
    '.xml': 'xml',
    '.yaml': 'yaml',
}
_PYTHON, _PACKAGES = 'docs/python/index.md', 'docs/packages/index.md'
_ADDED = {
    'Start': ['All pages </all_pages>'],
    'Reference': [f'/{site_path(_PYTHON)}', f'/{site_path(_PACKAGES)}'],
}
"""Entries of the navigation besides the pages that docs/README.md lists, by their group."""
_ABOUT_MODULES = """\
The public modules of the robot's packages. Those of the underlay have the interfaces of ROS 2
Jazzy: [the names of launch files](../reference/launch_names.md) and
[the packages for transforms](../reference/transforms.md) say what exists here.
"""
_ABOUT_PACKAGES = """\
What each package contains: nodes, topics, parameters, commands. First come the packages of the
robot (`src`), then those of the ROS 2 installation that comes with it (`tools/underlay`).
"""
_CHANGELOG = 'CHANGELOG.md'
_PROJECT = Group('Project', ('CONTRIBUTING.md', _CHANGELOG))


def write_pages(root: Path, folder: Path) -> dict[str, str]:
    """
    Write the sources of the site: pages, pictures, and pages that show other linked files.

    Parameters
    ----------
    root
        The workspace.
    folder
        The folder for the sources, which is empty or does not exist.

    Returns
    -------
    dict of str to str
        The file of the workspace, such as `docs/how-to/bags.md`, that each source shows.

    Raises
    ------
    SiteError
        The navigation lacks a page, or a link leads nowhere; the message says where.

    """
    pages = _pages(root)
    require_anchors(pages, partial(linked_file, root))
    shown: dict[str, str] = {}
    linked: set[str] = set()
    for page, text in pages.items():
        find = partial(linked_file, root, page)
        linked |= {find(path) for path in linked_files(text, page)}
        shown[page] = rewrite_page(text, page, find)
    for path in sorted(linked - {*pages}):
        if path.endswith(_PICTURES):
            (folder / site_path(path)).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(root / path, folder / site_path(path))
        else:
            shown[path] = _listing(path, (root / path).read_text(encoding='utf-8'))
    for page, text in shown.items():
        place = folder / site_path(page)
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text, encoding='utf-8')
    return {site_path(page): page for page in shown}


def _pages(root: Path) -> dict[str, str]:
    """Return the text of each page; those that are not files seem to be in docs."""
    packages = sorted(
        path.parent for path in root.glob('src/*/package.xml') if is_own_package(path.parent)
    )
    names = ['README.md', *_PROJECT.pages]
    names += [path.relative_to(root).as_posix() for path in sorted((root / 'docs').rglob('*.md'))]
    readmes = [package / 'README.md' for package in packages]
    readmes += sorted((root / 'tools' / 'underlay').glob('*/README.md'))
    names += [path.relative_to(root).as_posix() for path in readmes]
    pages = {name: (root / name).read_text(encoding='utf-8') for name in names}
    navigation = groups(pages['docs/README.md'])
    require_all(navigation, [name for name in names if name.startswith('docs/')])
    pages[_CHANGELOG] = with_anchors(pages[_CHANGELOG])
    pages['README.md'] += ''.join(_branches([*navigation, _PROJECT]))
    described = {
        f'docs/python/{package.name}.md': python_page(package.name, package, root)
        for package in packages
        if (package / package.name / '__init__.py').exists()
    }
    return {
        **pages,
        **described,
        _PYTHON: _index('Python modules', _ABOUT_MODULES, described),
        _PACKAGES: _index('Packages', _ABOUT_PACKAGES, names[-len(readmes) :]),
    }


def _branches(navigation: Iterable[Group]) -> Iterator[str]:
    """Format the navigation as hidden tables of contents, one for each group."""
    for group in navigation:
        entries = [*_entries(group.pages), *_ADDED.get(group.title, ())]
        yield _tree(entries, 'hidden:', f'caption: {group.title}')


def _index(title: str, text: str, pages: Iterable[str]) -> str:
    """Format a page that lists others."""
    return f'# {title}\n\n{text}\n{_tree(_entries(pages), "maxdepth: 1")}'


def _entries(pages: Iterable[str]) -> list[str]:
    """Return the entries of a table of contents for pages."""
    return [f'/{site_path(page)}' for page in pages]


def _tree(entries: Iterable[str], *options: str) -> str:
    """Format a table of contents."""
    lines = [*(f':{option}' for option in options), '', *entries]
    return '\n'.join(['', '```{toctree}', *lines, '```', ''])


def _listing(path: str, text: str) -> str:
    """Format a page that shows the text of a file, which search does not cover."""
    language = _LANGUAGES.get(PurePosixPath(path).suffix, 'none')
    fence = '`' * 8
    return (
        f'---\norphan: true\nnosearch: true\n---\n\n# `{PurePosixPath(path).name}`\n\n`{path}`\n\n'
        f'{fence}{{code-block}} {language}\n:linenos:\n:force:\n\n{text.rstrip()}\n{fence}\n'
    )
