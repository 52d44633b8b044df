# SPDX-License-Identifier: Apache-2.0
"""The names that tests of ROS packages use."""

from __future__ import annotations

import subprocess
import sys

import launch_testing
import pytest

NAMES = """
ActiveIoHandler ActiveProcInfoHandler IoHandler LaunchTestService ProcInfoHandler parametrize
post_shutdown_test actions.ReadyToTest asserts.EXIT_OK asserts.EXIT_SIGINT asserts.EXIT_SIGKILL
asserts.EXIT_SIGQUIT asserts.EXIT_SIGSEGV asserts.NO_CMD_ARGS asserts.assertExitCodes
asserts.assertInStderr asserts.assertInStdout asserts.assertInStream
asserts.assertSequentialStdout asserts.assert_sequential_output.SequentialTextChecker
event_handlers.StdoutReadyListener legacy.LaunchTestService
markers.keep_alive markers.retry_on_failure tools.ProcessProxy tools.basic_output_filter
tools.expect_output tools.expected_output_from_file tools.launch_process
tools.output.get_default_filtered_prefixes util.KeepAliveProc util.NoMatchingProcessException
util.resolveProcesses
""".split()


@pytest.mark.parametrize('name', NAMES)
def test_attribute(name: str) -> None:
    """A plain `import launch_testing` is enough to reach each name."""
    value = launch_testing
    for part in name.split('.'):
        assert part in dir(value) or hasattr(value, part)
        value = getattr(value, part)


def test_functions_stay_functions() -> None:
    """Names that are functions are not hidden by modules, whatever was imported before."""
    code = (
        'import launch_testing.loader, launch_testing; '
        'assert callable(launch_testing.parametrize); '
        'assert callable(launch_testing.post_shutdown_test)'
    )
    subprocess.run([sys.executable, '-c', code], check=True)
