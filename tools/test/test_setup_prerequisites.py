# SPDX-License-Identifier: Apache-2.0
"""Tests of the checks before the set-up."""

from __future__ import annotations

from pathlib import Path
import subprocess
import sys

import prerequisites
import pytest


@pytest.mark.parametrize('version', [(3, 10), (3, 11), (3, 12), (3, 13)])
def test_supported_pythons_pass(version: tuple[int, int]) -> None:
    """Every Python with wheels is accepted."""
    assert prerequisites.python_problem(version, 'CPython') is None


@pytest.mark.parametrize('version', [(3, 9), (3, 14), (4, 0)])
def test_other_pythons_are_named_with_a_way_out(version: tuple[int, int]) -> None:
    """An unsupported Python is named, with the command that mends it."""
    problem = prerequisites.python_problem(version, 'CPython')
    assert '{}.{}'.format(*version) in problem
    assert 'make setup PYTHON=python3.12' in problem


def test_pypy_is_refused() -> None:
    """The wheels are CPython's."""
    assert 'PyPy' in prerequisites.python_problem((3, 11), 'PyPy')


def test_other_machines_are_named() -> None:
    """Neither an ARM machine nor an old or other C library has wheels."""
    assert 'aarch64' in prerequisites.platform_problem('linux', 'aarch64', ('glibc', '2.36'))
    assert 'darwin' in prerequisites.platform_problem('darwin', 'x86_64', ('glibc', '2.36'))
    assert '2.17' in prerequisites.platform_problem('linux', 'x86_64', ('glibc', '2.17'))
    assert 'not glibc' in prerequisites.platform_problem('linux', 'x86_64', ('', ''))
    assert prerequisites.platform_problem('linux', 'x86_64', ('glibc', '2.28')) is None


def test_a_missing_compiler_is_named(tmp_path: Path) -> None:
    """No compiler on the PATH: the command that installs one."""
    assert 'sudo apt install g++' in prerequisites.compiler_problem(str(tmp_path))
    compiler = tmp_path / 'g++'
    compiler.touch()
    compiler.chmod(0o755)
    assert prerequisites.compiler_problem(str(tmp_path)) is None


def test_missing_headers_are_named(tmp_path: Path) -> None:
    """Without Python.h no message package compiles."""
    assert 'sudo apt install python3' in prerequisites.headers_problem(str(tmp_path))


@pytest.mark.parametrize('path', ['/a:b/c', '/a;b', '/a"b', "/a'b", '/a$b', '/a\nb'])
def test_unusable_paths_are_refused(path: str) -> None:
    """A path that PATH or CMake cannot hold is refused at once."""
    assert 'move or rename' in prerequisites.path_problem(path)


def test_spaces_and_letters_are_fine() -> None:
    """Spaces and letters of any language are no problem."""
    assert prerequisites.path_problem('/home/José Müller/日本/my robots') is None


def test_a_full_disk_is_named(tmp_path: Path) -> None:
    """Too little room is said before the download."""
    assert 'MB free' in prerequisites.space_problem(str(tmp_path / 'not' / 'yet'), 10**18)
    assert prerequisites.space_problem(str(tmp_path), 1) is None


def test_the_first_files_parse_under_old_pythons(root: Path) -> None:
    """The files that refuse an old Python use no syntax that it lacks."""
    for name in ('__main__.py', 'prerequisites.py'):
        source = (root / 'tools' / 'setup' / name).read_text()
        compile(source, name, 'exec', dont_inherit=True)
        check = f'import ast; ast.parse({source!r}, feature_version=(3, 4))'
        subprocess.run([sys.executable, '-c', check], check=True)
