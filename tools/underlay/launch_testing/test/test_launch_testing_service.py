# SPDX-License-Identifier: Apache-2.0
"""Launches some of whose actions are tests."""

from __future__ import annotations

import asyncio
import re
from typing import Any

from launch import LaunchDescription, LaunchService
from launch.actions import ExecuteProcess, OpaqueCoroutine
from launch_testing.legacy import LaunchTestService
from launch_testing.util import KeepAliveProc
import pytest


def run(tests: LaunchTestService, description: LaunchDescription) -> int:
    """Launch a description with tests."""
    service = LaunchService()
    service.include_launch_description(description)
    return tests.run(service)


@pytest.mark.parametrize(('code', 'status'), [(0, 0), (3, 1)])
def test_process(code: int, status: int, capfd: pytest.CaptureFixture[str]) -> None:
    """A process is a test; the launch ends with it, and the status tells how it went."""
    tests, description = LaunchTestService(), LaunchDescription()
    tests.add_fixture_action(description, KeepAliveProc())
    tests.add_test_action(description, ExecuteProcess(cmd=['sh', '-c', f'exit {code}']))
    assert run(tests, description) == status
    assert ('test 1 failed: its exit code is 3' in capfd.readouterr().err) == (code == 3)


def test_coroutine() -> None:
    """A coroutine is a test, too; all tests must succeed."""

    async def work(fails: bool) -> None:
        await asyncio.sleep(0)
        assert not fails

    def outcome(*which: bool) -> int:
        tests, description = LaunchTestService(), LaunchDescription([KeepAliveProc()])
        for fails in which:
            action = OpaqueCoroutine(coroutine=work, args=[fails], ignore_context=True)
            tests.add_test_action(description, action)
        return run(tests, description)

    assert outcome(False, False) == 0
    assert outcome(False, True) == 1


@pytest.mark.parametrize(
    ('expected', 'status'), [('hello', 0), (re.compile('h.*o'), 0), (['hello', 'x'], 1)]
)
def test_output(expected: Any, status: int) -> None:
    """The output of a process is a test; so is its absence at the end of the process."""
    tests = LaunchTestService()
    action = ExecuteProcess(cmd=['echo', 'hello'])
    description = LaunchDescription([action, KeepAliveProc()])
    tests.add_output_test(description, action, expected, side_effect='shutdown')
    assert run(tests, description) == status


def test_required_fixture(capfd: pytest.CaptureFixture[str]) -> None:
    """A required fixture that ends before the tests lets them fail."""
    tests, description = LaunchTestService(), LaunchDescription()
    tests.add_test_action(description, ExecuteProcess(cmd=['sleep', '100']))
    tests.add_fixture_action(description, ExecuteProcess(cmd=['true']), required=True)
    assert run(tests, description) == 1
    assert 'ended before the tests' in capfd.readouterr().err


def test_unknown_side_effect() -> None:
    """Only one side effect is known."""
    with pytest.raises(ValueError, match="side_effect is None or 'shutdown', not 'x'"):
        LaunchTestService().add_output_test(
            LaunchDescription(), ExecuteProcess(cmd=['true']), 'x', side_effect='x'
        )
