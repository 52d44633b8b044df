# SPDX-License-Identifier: Apache-2.0
"""The log of calls."""

from __future__ import annotations

import json
import os
from pathlib import Path

from humanoid_common.errors import UserError
from humanoid_common.testing.ros import ros_sandbox
import pytest
from robot_mcp.audit import AuditLog, default_path
from robot_mcp.robot_mcp import RobotMcp


def test_lines_are_appended(tmp_path: Path) -> None:
    """One a call, whoever else writes; only the owner may read it."""
    path = tmp_path / 'new' / 'audit.jsonl'
    warnings: list[str] = []
    for number in range(2):
        log = AuditLog(path, warnings.append)
        log.write('a client', 'say', {'text': 'one\ntwo "three" \x1b[2J'}, f'done: {number}')
    lines = [json.loads(line) for line in path.read_text().splitlines()]
    assert [each['outcome'] for each in lines] == ['done: 0', 'done: 1']
    assert lines[0]['arguments'] == {'text': 'one\ntwo "three" \x1b[2J'}
    assert {*lines[0]} == {'time', 'client', 'tool', 'arguments', 'outcome'}
    assert '\x1b' not in path.read_text()
    assert path.stat().st_mode & 0o777 == 0o600 and warnings == []


def test_endless_arguments_are_cut(tmp_path: Path) -> None:
    """A line stays a line."""
    path = tmp_path / 'audit.jsonl'
    AuditLog(path, print).write('c' * 9999, 't' * 9999, {'text': 'x' * 99_999}, 'o' * 99_999)
    (line,) = path.read_text().splitlines()
    assert len(line) < 8000 and json.loads(line)['arguments'].endswith('...')


@pytest.mark.skipif(not os.path.exists('/dev/full'), reason='needs /dev/full')
def test_a_full_disk_breaks_nothing() -> None:
    """It is said once."""
    warnings: list[str] = []
    log = AuditLog(Path('/dev/full'), warnings.append)
    for _ in range(3):
        log.write('client', 'stop', {}, 'done')
    assert len(warnings) == 1 and '/dev/full' in warnings[0]


@pytest.mark.parametrize('kind', ['folder', 'link', 'pipe', 'below a file'])
def test_odd_places_break_nothing(kind: str, tmp_path: Path) -> None:
    """A link is not followed, a pipe that nobody reads does not block."""
    path, other = tmp_path / 'audit.jsonl', tmp_path / 'other'
    if kind == 'folder':
        path.mkdir()
    elif kind == 'link':
        other.write_text('mine')
        path.symlink_to(other)
    elif kind == 'pipe':
        os.mkfifo(path)
    else:
        other.write_text('mine')
        path = other / 'audit.jsonl'
    warnings: list[str] = []
    AuditLog(path, warnings.append).write('client', 'stop', {}, 'done')
    assert len(warnings) == 1
    assert not other.exists() or other.read_text() == 'mine'


def test_a_torn_line_is_mended(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """When there is room again, the next line begins in a new one."""
    path = tmp_path / 'audit.jsonl'
    write = os.write
    warnings: list[str] = []
    log = AuditLog(path, warnings.append)
    monkeypatch.setattr(os, 'write', lambda file, data: write(file, data[:10]))
    log.write('client', 'stop', {}, 'torn')
    monkeypatch.undo()
    log.write('client', 'stop', {}, 'whole')
    assert json.loads(path.read_text().splitlines()[1])['outcome'] == 'whole'
    assert len(warnings) == 1


def test_where_it_is() -> None:
    """Below ROS_HOME, or ~/.ros."""
    assert default_path({'ROS_HOME': '/r'}) == Path('/r/robot_mcp/audit.jsonl')
    assert default_path({}) == Path('~/.ros/robot_mcp/audit.jsonl').expanduser()


def test_a_home_folder_that_does_not_exist() -> None:
    """The node does not start, and says so."""
    pytest.importorskip('mcp')
    with ros_sandbox() as ros:
        with pytest.raises(UserError, match="there is no home folder '~no_one'"):
            ros.start(RobotMcp, {'audit_log': '~no_one/audit.jsonl'})
