# SPDX-License-Identifier: Apache-2.0
"""Test results of a launch."""

from __future__ import annotations

import time
from typing import Any, NamedTuple, Optional
import unittest

from launch_testing.loader import method_name

PASSED = 'passed'
FAILED = 'failed'
ERROR = 'error'
SKIPPED = 'skipped'


class Outcome(NamedTuple):
    """The outcome of a test."""

    class_name: str
    name: str
    outcome: str
    message: str
    duration_s: float


class TestResult(unittest.TextTestResult):
    """
    Test result that records the outcome and duration of each test.

    Parameters
    ----------
    *args, **kwargs
        As for `unittest.TextTestResult`.

    """

    __test__ = False

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.outcomes: list[Outcome] = []
        self._started_s = 0.0

    def startTest(self, test: unittest.TestCase) -> None:  # noqa: N802
        """
        Record the start of a test.

        Parameters
        ----------
        test
            As for `unittest.TestResult.startTest`.

        """
        self._started_s = time.monotonic()
        super().startTest(test)

    def addSuccess(self, test: unittest.TestCase) -> None:  # noqa: N802
        """
        Record a test that passed.

        Parameters
        ----------
        test
            As for `unittest.TestResult.addSuccess`.

        """
        super().addSuccess(test)
        self._note(test, PASSED)

    def addFailure(self, test: unittest.TestCase, err: Any) -> None:  # noqa: N802
        """
        Record a test in which an assertion failed.

        Parameters
        ----------
        test, err
            As for `unittest.TestResult.addFailure`.

        """
        super().addFailure(test, err)
        self._note(test, FAILED, self.failures[-1][1])

    def addError(self, test: unittest.TestCase, err: Any) -> None:  # noqa: N802
        """
        Record a test that raised an exception.

        Parameters
        ----------
        test, err
            As for `unittest.TestResult.addError`.

        """
        super().addError(test, err)
        self._note(test, ERROR, self.errors[-1][1])

    def addSkip(self, test: unittest.TestCase, reason: str) -> None:  # noqa: N802
        """
        Record a skipped test.

        Parameters
        ----------
        test, reason
            As for `unittest.TestResult.addSkip`.

        """
        super().addSkip(test, reason)
        self._note(test, SKIPPED, reason)

    def addExpectedFailure(self, test: unittest.TestCase, err: Any) -> None:  # noqa: N802
        """
        Record an expected failure of a test.

        Parameters
        ----------
        test, err
            As for `unittest.TestResult.addExpectedFailure`.

        """
        super().addExpectedFailure(test, err)
        self._note(test, PASSED)

    def addUnexpectedSuccess(self, test: unittest.TestCase) -> None:  # noqa: N802
        """
        Record an unexpected success of a test.

        Parameters
        ----------
        test
            As for `unittest.TestResult.addUnexpectedSuccess`.

        """
        super().addUnexpectedSuccess(test)
        self._note(test, FAILED, 'the test passed, but was expected to fail')

    def addSubTest(  # noqa: N802
        self,
        test: unittest.TestCase,
        subtest: unittest.TestCase,
        err: Optional[Any],
    ) -> None:
        """
        Record a failed subtest.

        Parameters
        ----------
        test, subtest, err
            As for `unittest.TestResult.addSubTest`.

        """
        super().addSubTest(test, subtest, err)
        if err is not None:
            is_failure = issubclass(err[0], AssertionError)
            text = (self.failures if is_failure else self.errors)[-1][1]
            self._note(test, FAILED if is_failure else ERROR, text)

    def add_launch_failure(self, run_name: str, message: str) -> None:
        """
        Record a failure of the launch itself.

        Parameters
        ----------
        run_name, message
            The name of the run and the error message.

        """
        self.outcomes.append(Outcome('launch', run_name, ERROR, message, 0.0))

    def wasSuccessful(self) -> bool:  # noqa: N802
        """Check whether no test and no launch has failed."""
        return not self.problems()

    def problems(self) -> list[Outcome]:
        """Return the outcomes of failed tests and launches."""
        return [each for each in self.outcomes if each.outcome in (FAILED, ERROR)]

    def _note(self, test: unittest.TestCase, outcome: str, message: str = '') -> None:
        class_name, name = 'unittest', str(test)  # what fails for a whole class is no test case
        if isinstance(test, unittest.TestCase):
            class_name, name = type(test).__qualname__, method_name(test)
        duration_s = time.monotonic() - self._started_s
        self.outcomes.append(Outcome(class_name, name, outcome, message, duration_s))
