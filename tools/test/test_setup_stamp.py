# SPDX-License-Identifier: Apache-2.0
"""Tests of the stamps that tell whether a result is that of its sources."""

from __future__ import annotations

from pathlib import Path

from stamp import digest, files_below, Stamp


def test_a_digest_changes_with_contents_names_and_texts(tmp_path: Path) -> None:
    """Each of them makes another digest."""
    one, two = tmp_path / 'one', tmp_path / 'two'
    one.write_text('a')
    two.write_text('a')
    first = digest([one])
    assert digest([one]) == first
    assert len({first, digest([two]), digest([one, two]), digest([one], 'more')}) == 4
    one.write_text('b')
    assert digest([one]) != first


def test_caches_and_tests_are_not_sources(tmp_path: Path) -> None:
    """What building does not install does not make it build again."""
    for name in ('package/node.py', 'package/__pycache__/node.pyc', 'test/test_node.py'):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    assert list(files_below(tmp_path)) == [str(tmp_path / 'package' / 'node.py')]


def test_a_cleared_stamp_matches_nothing(tmp_path: Path) -> None:
    """While a result is being made it is nobody's."""
    stamp = Stamp(tmp_path / 'kept' / 'stamp')
    assert not stamp.matches('x')
    stamp.write('x')
    assert stamp.matches('x')
    assert not stamp.matches('y')
    stamp.clear()
    assert not stamp.matches('x')
