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
    """Launches one description after the other, and runs the tests on each."""

    def __init__(
        self,
        test_runs: Iterable[TestRun],
        launch_file_arguments: Sequence[str] = (),
        debug: bool = False,
        verbosity: int = 1,
        stream: Optional[TextIO] = None,
    ) -> None:
        """
        Create a runner.

        :param test_runs: what to run
        :param launch_file_arguments: the arguments of the launch descriptions (`name:=value`)
        :param debug: whether the launch tells more
        :param verbosity: how much is told about the tests, as for unittest
        :param stream: where that is told; the standard error output if it is None
        """
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
