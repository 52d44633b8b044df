# SPDX-License-Identifier: Apache-2.0
"""Tests of how the packages depend on each other."""

from __future__ import annotations

from pathlib import Path

import figures  # tools/reference is on the path here
import pytest

PACKAGES = figures.packages()
TOP_NAMES = figures.top_names()


def private_imports(folder: Path) -> list[str]:
    """Return what a package imports of the private parts of others."""
    return figures.private_imports(figures.modules(folder), TOP_NAMES)


@pytest.mark.parametrize('package', PACKAGES)
def test_what_is_private_stays_in_its_package(package: str) -> None:
    """No package imports a private module of another one."""
    assert private_imports(PACKAGES[package]) == []


@pytest.mark.parametrize(
    ('line', 'found'),
    [
        ('from tf2_py._frame_store import FrameStore', ['launch: tf2_py._frame_store.FrameStore']),
        ('from tf2_py import _frame_store', ['launch: tf2_py._frame_store']),
        ('import tf2_py._frame_store', ['launch: tf2_py._frame_store']),
        ('def late(): import tf2_py._frame_store', ['launch: tf2_py._frame_store']),
        ('from tf2_py import __doc__, BufferCore', []),
        ('from tf2_ros.inner._part import Part', ['launch: tf2_ros.inner._part.Part']),
        ('from concurrent.futures._base import Future', []),
    ],
)
def test_private_imports_are_seen(tmp_path: Path, line: str, found: list[str]) -> None:
    """Each way of importing counts, but not the standard library."""
    (tmp_path / 'launch.py').write_text(f'{line}\n')
    assert private_imports(tmp_path) == found


@pytest.mark.parametrize(
    ('line', 'found'),
    [
        ('from viser._messages import Message', ['launch: viser._messages.Message']),
        ('from numpy import _private', ['launch: numpy._private']),
        ('from launch._context import Context', []),
        ('import _thread, _csv', ['launch: _csv', 'launch: _thread']),
        ('from _thread import interrupt_main', []),
        ('from __future__ import annotations', []),
    ],
)
def test_private_imports_of_libraries_are_counted(
    tmp_path: Path, line: str, found: list[str]
) -> None:
    """With those of all libraries, but without documented functions."""
    module = figures.Module('launch', tmp_path / 'launch.py', f'{line}\n')
    assert figures.private_imports({'launch': module}) == found


@pytest.mark.parametrize(
    ('line', 'found'),
    [
        ('message._check_fields = False', ['1: message._check_fields']),
        ('self.node._clock.now()', ['1: self.node._clock']),
        ('self._clock.now()', []),
        ('super()._look()', []),
        ('message.__class__', []),
        ('os._exit(0)', []),
        ('atexit._run_exitfuncs()', ['1: atexit._run_exitfuncs']),
        ("getattr(node, '_clock', None)", ["1: getattr(node, '_clock', None)"]),
        ("setattr(self.node, '_clock', 0)", ["1: setattr(self.node, '_clock', 0)"]),
        ("hasattr(self, '_clock')", []),
        ("getattr(node, 'clock')", []),
        ("text.startswith('_clock')", []),
        ('pair._replace(first=1)', []),
    ],
)
def test_private_names_of_others_are_seen(tmp_path: Path, line: str, found: list[str]) -> None:
    """Accesses to private attributes of other objects count, but not documented functions."""
    module = figures.Module('launch', tmp_path / 'launch.py', f'{line}\n')
    assert figures.foreign_private_names(module) == found
