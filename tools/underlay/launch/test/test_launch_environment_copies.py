# SPDX-License-Identifier: Apache-2.0
"""Tests of the variables that processes are given, copied only when they have changed."""

import os

from launch.descriptions import Executable
from launch.launch_context import LaunchContext
import pytest


def environment_of_new_process() -> dict[str, str]:
    """Return what a process would find that is described now."""
    description = Executable(cmd=['/bin/true'])
    description.prepare(LaunchContext())
    environment = description.final_env
    assert environment is not None
    return environment


def test_changes_are_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """A variable that is set, changed or removed between two processes is that for the second."""
    for text in ('one', 'two'):
        monkeypatch.setenv('LAUNCH_WORD', text)
        assert environment_of_new_process()['LAUNCH_WORD'] == text
    monkeypatch.delenv('LAUNCH_WORD')
    assert 'LAUNCH_WORD' not in environment_of_new_process()
    assert environment_of_new_process() == dict(os.environ)


def test_processes_share_nothing() -> None:
    """What is changed for one process is not changed for the next."""
    environment_of_new_process()['LAUNCH_WORD'] = 'mine'
    assert 'LAUNCH_WORD' not in environment_of_new_process()
