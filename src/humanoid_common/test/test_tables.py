# SPDX-License-Identifier: Apache-2.0
"""Check how YAML files are read, and what is said about their mistakes."""

from __future__ import annotations

from collections.abc import Callable
import math
import os
from pathlib import Path
from typing import Any

from humanoid_common.errors import UserError
from humanoid_common.tables import load_table, Table, table_of, TableError
import pytest

TEXT = """# A robot
name: left
speed_m_s: 0.5
steps: 3
joints: [hip, knee]
arm:
  mode: slow
things:
  - at: [1, 2.5]
"""


def test_values() -> None:
    """Each is read as what it must be; what is not set has its default."""
    table = table_of(TEXT, 'robot.yaml')
    table.allow('name', 'speed_m_s', 'steps', 'joints', 'arm', 'things')
    assert table.text('name') == 'left'
    assert table.number('speed_m_s', limits=(0.0, 0.5)) == 0.5
    assert table.number('turn_rad_s', 0.25) == 0.25
    assert (table.integer('steps', 1), table.integer('rounds', 7)) == (3, 7)
    assert table.table('arm').choice('mode', ('fast', 'slow'), 'fast') == 'slow'
    assert [each.vector('at', 2) for each in table.tables('things')] == [(1.0, 2.5)]
    assert not table.table('leg').names


@pytest.mark.parametrize(
    ('read', 'message'),
    [
        (lambda table: table.allow('name'), "line 3: the file has an unknown key 'speed_m_s'."),
        (
            lambda table: table.number('name'),
            "line 2: name must be a finite number, but is 'left'.",
        ),
        (
            lambda table: table.number('speed_m_s', None, (1.0, 2.0)),
            'line 3: speed_m_s must be a finite number from 1 to 2, but is 0.5.',
        ),
        (
            lambda table: table.number('speed_m_s', None, (1.0, math.inf)),
            'must be a finite number of at least 1, but is 0.5.',
        ),
        (
            lambda table: table.integer('steps', 1, (4, math.inf)),
            'a whole number of at least 4, but is 3.',
        ),
        (lambda table: table.integer('speed_m_s', 1), 'must be a whole number of at least 0'),
        (lambda table: table.text('legs'), "line 1: the file lacks the required key 'legs'."),
        (lambda table: table.table('name'), 'line 2: name must be a mapping of names to values'),
        (
            lambda table: table.table('arm').choice('mode', ('fast', 'slower')),
            "line 7: arm.mode must be one of fast, slower, but is 'slow'. Did you mean 'slower'?",
        ),
        (
            lambda table: next(table.tables('things')).vector('at', 3),
            'line 9: things[0].at must be a list of 3 finite numbers',
        ),
    ],
)
def test_mistakes(read: Callable[[Table], Any], message: str) -> None:
    """The message gives the file, the line, the key and what it must be."""
    with pytest.raises(TableError) as caught:
        read(table_of(TEXT, 'robot.yaml'))
    assert str(caught.value).startswith('robot.yaml, ')
    assert message in str(caught.value)


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    """None there, a folder, a pipe, and no text."""
    path = tmp_path / 'robot.yaml'
    with pytest.raises(TableError, match='cannot be read: No such file'):
        load_table(path)
    with pytest.raises(TableError, match='is a folder. Give the path of a YAML file'):
        load_table(tmp_path)
    os.mkfifo(tmp_path / 'pipe.yaml')
    with pytest.raises(TableError, match='is a device. Give the path'):
        load_table(tmp_path / 'pipe.yaml')
    path.write_bytes(b'\xff\xfe')
    with pytest.raises(TableError, match='is not a valid YAML file: .*utf-8'):
        load_table(path)


@pytest.mark.parametrize(
    ('text', 'message'),
    [
        ('joints: [a', r" \(line 1, column 11\): expected ',' or '\]'.*\.$"),
        (
            'action:\n\tscale_rad: 1.0',
            r' \(line 2, column 1\): found character .*spaces instead\.$',
        ),
        ('model: a\x07b', ': unacceptable character'),
        ('rate_hz: 2026-13-01', r': month must be in 1\.\.12'),
        ('[' * 5000, ': maximum recursion depth'),
        ('rate_hz: ' + '9' * 5000, ': Exceeds the limit'),
        ('a: 1\nb: 2\na: 3', r" \(line 3, column 1\): duplicate key 'a', also on line 1"),
        ('? [a]\n: b', r' \(line 1, column 3\): found unhashable key'),
        ('', ', line 1: the file must be a mapping of names to values, but is empty'),
        ('- a', r", line 1: the file must be a mapping of names to values, but is \['a'\]"),
        ('just words', "must be a mapping of names to values, but is 'just words'"),
    ],
)
def test_texts_that_are_no_table(text: str, message: str) -> None:
    """Each is refused in one line that says where the mistake is."""
    with pytest.raises(TableError, match=message) as caught:
        table_of(text, 'robot.yaml')
    assert len(str(caught.value).splitlines()) == 1


def test_numbers_that_are_too_large() -> None:
    """No float can have them."""
    for digits, said in (('1' + '0' * 400, r'1000.*\.\.\.'), ('0x' + 'f' * 5000, 'too large a')):
        with pytest.raises(TableError, match=f'mass_kg must be a finite number, but is {said}'):
            table_of(f'mass_kg: {digits}', 'robot.yaml').number('mass_kg')


def test_where_an_error_of_an_object_is() -> None:
    """An error of what is built from a table gets the location; one that has it keeps it."""

    def fail(error: UserError) -> Any:
        raise error

    place = table_of(TEXT, 'robot.yaml').at('arm')
    with pytest.raises(TableError, match='robot.yaml, line 6: It is too long.'):
        place.checked(lambda: fail(UserError('It is too long.')))
    with pytest.raises(TableError, match='^Known already.$'):
        place.checked(lambda: fail(TableError('Known already.')))
    assert place.checked(lambda: 3) == 3
