# SPDX-License-Identifier: Apache-2.0
"""Tests of the site's structure and links; `make site` itself fails on any warning."""

from __future__ import annotations

from functools import partial
from pathlib import Path
import re

from changelog import with_anchors
import commands
from contents import Group, groups, require_all, SiteError  # tools/site is on the path here
from links import linked_file, linked_files, require_anchors, rewrite_page, site_path
from locations import Locations
import processes
import pytest
import wheels


def pins(path: Path) -> list[str]:
    """Return the entries of a requirements file, each with its hashes."""
    lines = [line for line in path.read_text().splitlines() if not line.startswith('#')]
    return re.split(r'\n(?=\S)', '\n'.join(lines))


def test_every_page_is_in_the_navigation(root: Path) -> None:
    """Each page of docs has its row in docs/README.md, in the groups that readers look for."""
    found = groups((root / 'docs' / 'README.md').read_text())
    assert [each.title for each in found] == [
        *('Start', 'Learn', 'How-to', 'Reference', 'Explanation'),
    ]
    require_all(found, [str(path.relative_to(root)) for path in root.glob('docs/**/*.md')])


@pytest.mark.parametrize(
    ('listed', 'existing', 'message'),
    [
        ((), ('docs/how-to/bags.md',), 'docs/how-to/bags.md is in no table of docs/README.md'),
        (('docs/old.md',), (), 'docs/README.md links to docs/old.md, which does not exist'),
        (('docs/a.md', 'docs/a.md'), ('docs/a.md',), 'lists docs/a.md more than once'),
    ],
)
def test_a_wrong_navigation_is_refused(
    listed: tuple[str, ...], existing: tuple[str, ...], message: str
) -> None:
    """A page that is missing, gone or listed twice is named, with what to do."""
    with pytest.raises(SiteError, match=message):
        require_all([Group('How-to', listed)], ['docs/README.md', *existing])


@pytest.mark.parametrize(
    ('path', 'place'),
    [
        ('README.md', 'index.md'),
        ('docs/how-to/bags.md', 'how-to/bags.md'),
        ('docs/pictures/rooms.png', 'pictures/rooms.png'),
        ('src/humanoid_control/README.md', 'packages/humanoid_control.md'),
        ('tools/underlay/tf2_ros/README.md', 'packages/tf2_ros.md'),
        ('src/robot_mcp/setup.py', 'source/src/robot_mcp/setup.py.md'),
        ('tools/notes/README.md', 'source/tools/notes/README.md.md'),
    ],
)
def test_each_file_has_a_place(path: str, place: str) -> None:
    """Pages of docs keep their place; packages and other files have folders of their own."""
    assert site_path(path) == place


@pytest.mark.parametrize(
    ('page', 'text', 'rewritten'),
    [
        ('docs/how-to/a.md', '[b](b.md#c)', '[](b.md#c)'),
        ('docs/how-to/a.md', '[see b](b.md#c)', '[see b](b.md#c)'),
        ('docs/how-to/a.md', '[x/b.md](../x/b.md) says', '*[](../x/b.md)* says'),
        ('docs/how-to/a.md', '[here](#c) [web](https://x.org/a.md)', None),
        ('docs/how-to/a.md', '[start](../../README.md)', '[start](../index.md)'),
        ('docs/how-to/a.md', '[`f`](../../src/p/f.py)', '[`f`](../source/src/p/f.py.md)'),
        ('docs/how-to/a.md', '[p](../../src/p)', '[p](../packages/p.md)'),
        ('docs/how-to/a.md', '`[b](../../b.py)`', None),
        ('docs/how-to/a.md', '```text\n[b](../../b.py)\n```', None),
        ('docs/how-to/a.md', '```bash terminal\nls\n```', None),
        ('docs/a.md', '```python file=~/b.py\n```', '```{written-file} python ~/b.py\n```'),
        ('README.md', '![A picture](docs/pictures/a.png)', '![A picture](pictures/a.png)'),
        ('README.md', '[docs/a.md](docs/a.md)', '*[](a.md)*'),
        ('src/p/README.md', '[how](../../docs/how-to/a.md)', '[how](../how-to/a.md)'),
    ],
)
def test_links_lead_to_the_place_in_the_site(page: str, text: str, rewritten: str | None) -> None:
    """Links to files of the workspace are rewritten; code, anchors and addresses stay."""

    def file_of(path: str) -> str:
        return f'{path}/README.md' if path == 'src/p' else path

    assert rewrite_page(text, page, file_of) == (text if rewritten is None else rewritten)


def test_linked_files_are_found_outside_code() -> None:
    """What a page links to is found, relative to the workspace."""
    text = '[a](../a.py) `[b](b.py)` ![c](../pictures/c.png)\n```text\n[d](d.py)\n```\n[e](#e)'
    assert [*linked_files(text, 'docs/how-to/p.md')] == ['docs/a.py', 'docs/pictures/c.png']


def test_the_links_of_the_site_lead_to_files_and_headings(root: Path) -> None:
    """What the pages of the site link to exists, down to the heading."""
    patterns = ('*.md', 'docs/**/*.md', 'src/*/README.md', 'tools/underlay/*/README.md')
    paths = [path for pattern in patterns for path in root.glob(pattern)]
    pages = {path.relative_to(root).as_posix(): path.read_text() for path in paths}
    linked = [
        linked_file(root, page, path)
        for page, text in pages.items()
        for path in linked_files(text, page)
    ]
    assert len(linked) > len(pages)
    require_anchors(pages, partial(linked_file, root))


@pytest.mark.parametrize(
    ('link', 'wrong'),
    [
        ('b.md#what-ros2-run-starts', ''),
        ('b.md#twice-1', ''),
        ('#its-own', ''),
        ('b.md#twice-2', '#twice-2 of b.md'),
        ('b.md#a-comment', '#a-comment of b.md'),
        ('#what-ros2-run-starts', '#what-ros2-run-starts of a.md'),
    ],
)
def test_a_link_to_a_heading_that_is_missing_is_refused(link: str, wrong: str) -> None:
    """The page, the heading and the page that lacks it are named."""
    other = '# What `ros2 run` starts\n\n## Twice\n\n## Twice\n\n```bash\n# a comment\n```\n'
    pages = {'a.md': f'# Its own\n\n[see]({link})\n', 'b.md': other}
    if not wrong:
        require_anchors(pages, lambda page, path: path)
        return
    with pytest.raises(SiteError, match=f'^a.md links to {wrong}, which has no such heading'):
        require_anchors(pages, lambda page, path: path)


def test_a_link_to_a_file_that_is_missing_is_refused(tmp_path: Path) -> None:
    """A folder stands for its README; the page is named that links to nothing."""
    (tmp_path / 'p').mkdir()
    (tmp_path / 'p' / 'README.md').write_text('# p\n')
    assert linked_file(tmp_path, 'a.md', 'p') == 'p/README.md'
    with pytest.raises(SiteError, match='^a.md links to q, which is neither a file'):
        linked_file(tmp_path, 'a.md', 'q')


def test_versions_of_the_changelog_have_anchors_that_stay() -> None:
    """A release keeps its anchor when there are newer ones, and line numbers stay."""
    older = '\n## [1.0.0] - 2026-01-02\n\n### Added\n\n- x\n'
    named = '(v1-0-0)=\n## [1.0.0] - 2026-01-02\n(v1-0-0-added)=\n### Added\n\n- x\n'
    assert with_anchors(f'# Changelog\n{older}') == f'# Changelog\n{named}'
    newer = '# Changelog\n\n## Unreleased\n\n### Added\n\n- y\n'
    assert with_anchors(newer + older) == (
        f'# Changelog\n\n## Unreleased\n(unreleased-added)=\n### Added\n\n- y\n{named}'
    )


def test_what_the_site_needs_is_pinned_and_nobody_else_installs_it(root: Path) -> None:
    """Each requirement has one version for each Python, and the digests of its files."""
    entries = pins(root / 'requirements-site.txt')
    assert [
        each for each in entries if not re.match(r'[\w.-]+==\S+ .*--hash=sha256:', each, re.S)
    ] == []
    needed = wheels.pinned_names((root / 'tools' / 'setup' / 'requirements-site.in').read_text())
    assert needed
    for name in needed:
        assert any(each.startswith(f'{name}==') for each in entries), name
        for other in ('requirements', 'requirements-parts', 'requirements-test'):
            assert f'\n{name}==' not in (root / f'{other}.txt').read_text(), name


def test_the_site_has_an_environment_of_its_own(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is made once, inside the environment, and neither compiler nor ROS is asked for."""
    done: list[str] = []
    monkeypatch.setattr(wheels, 'make_environment', lambda there, python: done.append('made'))
    monkeypatch.setattr(wheels, 'fetch_wheels', lambda there, *rest: done.append('fetched'))
    monkeypatch.setattr(
        processes, 'run', lambda command, **options: done.append(str(command[0])) or 3
    )
    there = Locations(tmp_path, tmp_path / '.venv', tmp_path / '.venv')
    assert [commands.run('site', there, []) for _ in range(2)] == [3, 3]
    python = str(tmp_path / '.venv' / 'site' / 'bin' / 'python3')
    assert done == ['made', 'fetched', python, python]
