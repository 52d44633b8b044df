# SPDX-License-Identifier: Apache-2.0
"""Run the tests of a launch test file: launch each description once, and run its tests."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
import sys
import threading
from typing import Any, Optional, TextIO
import unittest

from launch import LaunchDescription, LaunchService
from launch.actions import IncludeLaunchDescription, RegisterEventHandler
from launch.launch_description_source import LaunchDescriptionSource
from launch_testing.loader import TestRun
from launch_testing.markers import is_kept_alive
from launch_testing.observation import Observation, ReadyHandler
from launch_testing.test_result import TestResult

__all__ = ['LaunchTestRunner']

_READY_TIMEOUT_S = 15.0
_PATIENCE_S = 5.0


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


class SingleRun:
    """
    Runner that executes a launch in the calling thread and its tests in another thread.

    When the tests are done, the launch is shut down; the post-shutdown tests then run in the
    calling thread.

    Parameters
    ----------
    run
        The launch description and its tests.
    arguments : Sequence[str]
        The arguments of the launch description (`name:=value`).
    debug
        Whether the launch logs debug messages.
    verbosity
        The verbosity of the test output, as for unittest.
    ready_timeout_s
        The timeout for ReadyToTest, in s.
    stream
        The stream for the test output; None for the standard error.

    """

    def __init__(
        self,
        run: TestRun,
        arguments: Sequence[str],
        *,
        debug: bool = False,
        verbosity: int = 1,
        ready_timeout_s: float = _READY_TIMEOUT_S,
        stream: Optional[TextIO] = None,
    ) -> None:
        self._run = run
        self._arguments = list(arguments)
        self._verbosity = verbosity
        self._ready_timeout_s = ready_timeout_s
        self._stream = sys.stderr if stream is None else stream
        self._service = LaunchService(argv=self._arguments, noninteractive=True, debug=debug)
        self._observation = Observation()
        self._ready = threading.Event()
        self._injected: dict[str, Any] = {}
        self._result: TestResult = self._empty_result()
        self._is_over = self._was_ready = self._tests_done = False
        self._failure = ''

    def execute(self) -> TestResult:
        """Run the launch and all tests; return the result."""
        description, context = self._run.normalized_test_description(self._ready.set)
        observation = self._observation
        self._injected = {
            **context,
            'launch_service': self._service,
            'proc_info': observation.proc_info,
            'proc_output': observation.proc_output,
        }
        thread = threading.Thread(target=self._work, name='launch tests', daemon=True)
        thread.start()
        status = self._launch(description)
        self._is_over = True
        self._was_ready = self._ready.is_set()
        self._result.stop()  # before a test whose wait ends makes way for the next one
        observation.close()
        self._ready.set()
        thread.join(_PATIENCE_S)
        if observation.was_interrupted:
            raise KeyboardInterrupt
        self._judge(status)
        return self._result

    # The launch, in the calling thread.

    def _launch(self, description: LaunchDescription) -> int:
        pairs = [argument.partition(':=')[::2] for argument in self._arguments]
        source = LaunchDescriptionSource(description, method='function of a launch test')
        self._service.include_launch_description(
            LaunchDescription(
                [
                    *self._observation.actions(),
                    RegisterEventHandler(ReadyHandler(description, self._ready.set)),
                    IncludeLaunchDescription(source, launch_arguments=pairs),
                ]
            )
        )
        return self._service.run(
            shutdown_when_idle=not is_kept_alive(self._run.test_description_function)
        )

    def _judge(self, status: int) -> None:
        """Run the post-shutdown tests, or report why the launch itself failed."""
        if self._tests_done and status == 0:
            self._run_tests(self._run.post_shutdown_tests)
            return
        text = self._failure or self._observation.explain_end(status, was_ready=self._was_ready)
        text += self._observation.report()
        self._fail(text)

    # The tests, in another thread.

    def _work(self) -> None:
        try:
            if not self._ready.wait(self._ready_timeout_s):
                self._failure = (
                    f'The launch was not ready after {self._ready_timeout_s:g} s: its description '
                    'must contain the action launch_testing.actions.ReadyToTest, and that must '
                    'be visited in this time.'
                )
            elif not self._observation.is_closed:
                self._tests_done = self._run_tests(self._run.pre_shutdown_tests)
        finally:
            self._service.shutdown()

    def _run_tests(self, cases: list[unittest.TestCase]) -> bool:
        """Run tests and add their results; False if the end of the launch skipped any of them."""
        configurations = self._service.context.launch_configurations
        self._injected['test_args'] = {
            name: value for name, value in configurations.items() if isinstance(value, str)
        }
        try:
            suite = self._run.bind(cases, self._injected)
        except TypeError as error:
            self._fail(str(error))
            return True
        before = self._result.outcomes
        unittest.TextTestRunner(
            self._stream, verbosity=self._verbosity, resultclass=self._make_result
        ).run(suite)
        self._result.outcomes[:0] = before
        return not self._result.shouldStop or self._result.testsRun == suite.countTestCases()

    def _fail(self, text: str) -> None:
        print(f'{self._run}: {text}', file=self._stream)
        self._result.add_launch_failure(str(self._run), text)

    def _make_result(self, *args: Any, **kwargs: Any) -> TestResult:
        self._result = TestResult(*args, **kwargs)
        if self._is_over and not self._tests_done:
            self._result.stop()
        return self._result

    def _empty_result(self) -> TestResult:
        runner = unittest.TextTestRunner(self._stream, verbosity=self._verbosity)
        return TestResult(runner.stream, runner.descriptions, self._verbosity)
