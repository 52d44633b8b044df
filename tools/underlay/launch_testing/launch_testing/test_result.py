# SPDX-License-Identifier: Apache-2.0
"""The results of the tests of a launch."""

from __future__ import annotations

import time
from typing import Any, NamedTuple, Optional
import unittest

PASSED = 'passed'
FAILED = 'failed'
ERROR = 'error'
SKIPPED = 'skipped'


class Outcome(NamedTuple):
    """How one test went."""

    class_name: str
    name: str
    outcome: str
    message: str
    duration_s: float


class TestResult(unittest.TextTestResult):
    """
    Records how each test went, and how long it took.

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
        Note when a test begins.

        Parameters
        ----------
        test
            As for `unittest.TestResult.startTest`.

        """
        self._started_s = time.monotonic()
        super().startTest(test)

    def addSuccess(self, test: unittest.TestCase) -> None:  # noqa: N802
        """
        Note a test that passed.

        Parameters
        ----------
        test
            As for `unittest.TestResult.addSuccess`.

        """
        super().addSuccess(test)
        self._note(test, PASSED)

    def addFailure(self, test: unittest.TestCase, err: Any) -> None:  # noqa: N802
        """
        Note a test in which an assertion failed.

        Parameters
        ----------
        test, err
            As for `unittest.TestResult.addFailure`.

        """
        super().addFailure(test, err)
        self._note(test, FAILED, self.failures[-1][1])

    def addError(self, test: unittest.TestCase, err: Any) -> None:  # noqa: N802
        """
        Note a test that raised an exception.

        Parameters
        ----------
        test, err
            As for `unittest.TestResult.addError`.

        """
        super().addError(test, err)
        self._note(test, ERROR, self.errors[-1][1])

    def addSkip(self, test: unittest.TestCase, reason: str) -> None:  # noqa: N802
        """
        Note a test that was left out.

        Parameters
        ----------
        test, reason
            As for `unittest.TestResult.addSkip`.

        """
        super().addSkip(test, reason)
        self._note(test, SKIPPED, reason)

    def addExpectedFailure(self, test: unittest.TestCase, err: Any) -> None:  # noqa: N802
        """
        Note a test that failed as it should.

        Parameters
        ----------
        test, err
            As for `unittest.TestResult.addExpectedFailure`.

        """
        super().addExpectedFailure(test, err)
        self._note(test, PASSED)

    def addUnexpectedSuccess(self, test: unittest.TestCase) -> None:  # noqa: N802
        """
        Note a test that should have failed.

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
        Note a part of a test if it failed.

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
        Note that not a test failed, but the launch.

        Parameters
        ----------
        run_name, message
            The name of the run, and what went wrong.

        """
        self.outcomes.append(Outcome('launch', run_name, ERROR, message, 0.0))

    def wasSuccessful(self) -> bool:  # noqa: N802
        """Return whether all went well."""
        return not self.problems()

    def problems(self) -> list[Outcome]:
        """Return what did not go well."""
        return [each for each in self.outcomes if each.outcome in (FAILED, ERROR)]

    def _note(self, test: unittest.TestCase, outcome: str, message: str = '') -> None:
        class_name, name = type(test).__qualname__, getattr(test, '_testMethodName', str(test))
        if not hasattr(test, '_testMethodName'):
            class_name = 'unittest'
        duration_s = time.monotonic() - self._started_s
        self.outcomes.append(Outcome(class_name, name, outcome, message, duration_s))
