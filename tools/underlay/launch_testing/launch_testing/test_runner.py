# SPDX-License-Identifier: Apache-2.0
"""Run the tests of a launch test file."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, Optional, TextIO

from launch_testing._single_run import SingleRun
from launch_testing.loader import TestRun
from launch_testing.test_result import TestResult

__all__ = ['LaunchTestRunner']


class LaunchTestRunner:
    """
    Launches one description after the other, and runs the tests on each.

    Parameters
    ----------
    test_runs
        What to run.
    launch_file_arguments
        The arguments of the launch descriptions (`name:=value`).
    debug
        Whether the launch logs more.
    verbosity
        How much is told about the tests, as for unittest.
    stream
        Where that is told; None is the standard error output.

    """

    def __init__(
        self,
        test_runs: Iterable[TestRun],
        launch_file_arguments: Sequence[str] = (),
        debug: bool = False,
        verbosity: int = 1,
        stream: Optional[TextIO] = None,
    ) -> None:
        self._test_runs = list(test_runs)
        self._arguments = list(launch_file_arguments)
        self._options: dict[str, Any] = {
            'debug': debug,
            'verbosity': verbosity,
            'stream': stream,
        }

    def validate(self) -> None:
        """Raise an exception if a launch description cannot be had."""
        for run in self._test_runs:
            run.get_launch_description()

    def run(self) -> dict[TestRun, TestResult]:
        """Run all; return the result of each run."""
        return {
            run: SingleRun(run, self._arguments, **self._options).execute()
            for run in self._test_runs
        }
