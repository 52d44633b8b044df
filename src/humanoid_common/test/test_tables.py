# SPDX-License-Identifier: Apache-2.0
"""Check how YAML files are read, and what is said about their mistakes."""

from __future__ import annotations

from collections.abc import Callable
import math
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
        (lambda table: table.number('name'), "line 2: name must be a finite number, but is 'left'."),
        (
            lambda table: table.number('speed_m_s', None, (1.0, 2.0)),
            'line 3: speed_m_s must be a finite number from 1 to 2, but is 0.5.',
        ),
        (
            lambda table: table.number('speed_m_s', None, (1.0, math.inf)),
            'must be a finite number of at least 1, but is 0.5.',
        ),
        (lambda table: table.integer('steps', 1, (4, math.inf)), 'a whole number of at least 4, but is 3.'),
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
    """None there, a folder, no text, no YAML, a key twice, and no table."""
    path = tmp_path / 'robot.yaml'
    for wrong in (path, tmp_path):
        with pytest.raises(TableError, match='cannot be read: '):
            load_table(wrong)
    for content, message in (
        (b'\xff\xfe', 'is not a valid YAML file'),
        (b'a: [1', 'is not a valid YAML file'),
        (b'a: 1\nb: 2\na: 3\n', "duplicate key 'a', also on line 1: remove one of them"),
        (b'- a\n', 'line 1: the file must be a mapping of names to values'),
        (b'', 'line 1: the file must be a mapping of names to values, but is None.'),
    ):
        path.write_bytes(content)
        with pytest.raises(TableError) as caught:
            load_table(path)
        assert message in str(caught.value)


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
