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
    Runner that launches descriptions one after the other and runs their tests.

    Parameters
    ----------
    test_runs
        The launch descriptions with their tests.
    launch_file_arguments
        The arguments of the launch descriptions (`name:=value`).
    debug
        Whether the launch logs debug messages.
    verbosity
        The verbosity of the test output, as for unittest.
    stream
        The stream for the test output; None for the standard error.

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
        """Raise an exception if a launch description cannot be generated."""
        for run in self._test_runs:
            run.get_launch_description()

    def run(self) -> dict[TestRun, TestResult]:
        """Execute all runs; return the result of each run."""
        return {
            run: SingleRun(run, self._arguments, **self._options).execute()
            for run in self._test_runs
        }
