# SPDX-License-Identifier: Apache-2.0
"""Which programs can be forked."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
import os
from pathlib import Path
import sys

from launch._supervision.prefork.prefork import kind_of
from launch._supervision.program import Program
import pytest

ENVIRONMENT = {'PATH': '/bin', 'HOME': '/home/me', 'PYTHONPATH': '/a', 'LC_ALL': 'C.UTF-8'}
Script = Callable[[str], Program]


@pytest.fixture
def script(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Script:
    """Return a function that writes a script with a first line and returns the program."""
    (tmp_path / 'early_preload.py').write_text("EARLY_VARIABLES = frozenset({'EARLY'})\n")
    monkeypatch.syspath_prepend(str(tmp_path))

    def write(first_line: str) -> Program:
        path = tmp_path / 'script'
        path.write_text(f'{first_line}\npass\n')
        path.chmod(0o755)
        return Program([str(path)], None, None, False, 'early_preload')

    return write


def test_script_of_this_interpreter(script: Script, tmp_path: Path) -> None:
    """A script for the running interpreter can be forked, in whatever folder."""
    program = script(f'#!{sys.executable}')
    kind = kind_of(program, ENVIRONMENT)
    assert kind is not None and kind.interpreter == sys.executable
    assert kind_of(replace(program, cwd=str(tmp_path)), ENVIRONMENT) == kind


def test_script_of_this_interpreter_by_another_name(script: Script, tmp_path: Path) -> None:
    """The environment may be a link, as in a workspace whose path has spaces."""
    link = tmp_path / 'environment'
    link.symlink_to(os.path.dirname(sys.executable))
    interpreter = str(link / os.path.basename(sys.executable))
    kind = kind_of(script(f'#!{interpreter}'), ENVIRONMENT)
    assert kind is not None and kind.interpreter == interpreter


@pytest.mark.parametrize(
    'line',
    ['', 'print()', '#!/bin/sh', '#!/usr/bin/env python3', '#! /no/python3']
    + [f'#!{sys.executable} -u', f'# {sys.executable}'],
)
def test_other_files(script: Script, line: str) -> None:
    """What the system does not hand to the running interpreter alone is executed."""
    assert kind_of(script(line), ENVIRONMENT) is None


def test_circumstances(script: Script, tmp_path: Path) -> None:
    """A shell, a missing folder, a relative path or a file without permission prevent it."""
    program = script(f'#!{sys.executable}')
    path = program.command[0]
    others = [
        replace(program, shell=True),
        replace(program, preloader=None),
        replace(program, cwd=str(tmp_path / 'missing')),
        replace(program, command=['nice', path]),
        replace(program, command=[os.path.relpath(path)]),
        replace(program, command=[path, 'x' * 100_000]),
    ]
    assert [kind_of(other, ENVIRONMENT) for other in others] == [None] * len(others)
    os.chmod(path, 0o644)
    if os.getuid() != 0:
        assert kind_of(program, ENVIRONMENT) is None


@pytest.mark.parametrize('name', ['LD_PRELOAD', 'COVERAGE_PROCESS_START', 'PYTHONINSPECT'])
def test_variables_that_prevent_it(script: Script, name: str) -> None:
    """Some variables change what a process does from its first instant."""
    program = script(f'#!{sys.executable}')
    assert kind_of(program, {**ENVIRONMENT, name: '1'}) is None
    assert kind_of(program, {**ENVIRONMENT, name: ''}) is not None


@pytest.mark.parametrize(
    ('name', 'same'),
    [('LD_LIBRARY_PATH', False), ('PYTHONHASHSEED', False), ('LANG', False), ('TZ', False)]
    + [('OPENBLAS_NUM_THREADS', False), ('EARLY', False)]
    + [('ROS_DOMAIN_ID', True), ('ANY', True)],
)
def test_kind(script: Script, name: str, same: bool) -> None:
    """Programs are of one kind if they agree in what is read before they begin."""
    program = script(f'#!{sys.executable}')
    kinds = [kind_of(program, {**ENVIRONMENT, name: value}) for value in '12']
    assert None not in kinds and (kinds[0] == kinds[1]) == same
