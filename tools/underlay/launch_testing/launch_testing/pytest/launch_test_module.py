# SPDX-License-Identifier: Apache-2.0
"""Pytest collector and items of launch test files."""

from __future__ import annotations

from collections.abc import Iterable
import io
import os
from typing import Any, Union

from launch_testing.loader import LoadTestsFromPythonModule, TestRun
from launch_testing.test_result import SKIPPED, TestResult
from launch_testing.test_runner import LaunchTestRunner
import pytest


class LaunchTestFailure(Exception):
    """A launch or a test of it failed."""


class LaunchTestItem(pytest.Item):
    """
    Pytest item that runs all tests of a file on a launch description.

    Parameters
    ----------
    test_run
        The launch description and its tests.
    **kwargs
        The arguments of pytest.Item.

    """

    def __init__(self, *, test_run: TestRun, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.test_run = test_run

    def runtest(self) -> None:
        """Launch the description and run the tests; restore the environment afterwards."""
        arguments = self.config.getoption('--launch-args')
        runner = LaunchTestRunner([self.test_run], arguments, stream=io.StringIO())
        environment = dict(os.environ)
        try:
            (result,) = runner.run().values()
        finally:
            os.environ.clear()
            os.environ.update(environment)
        self._tell(result)

    def _tell(self, result: TestResult) -> None:
        """Report the individual tests, as properties for JUnit XML and as failures."""
        for each in result.outcomes:
            self.user_properties.append((f'{each.class_name}.{each.name}', each.outcome))
        problems = result.problems()
        if problems:
            raise LaunchTestFailure(
                '\n\n'.join(f'{each.class_name}.{each.name}\n{each.message}' for each in problems)
            )
        if result.outcomes and all(each.outcome == SKIPPED for each in result.outcomes):
            pytest.skip('; '.join(each.message for each in result.outcomes))

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """
        Format a failure, without the frames of the runner.

        Parameters
        ----------
        excinfo
            The exception that `runtest` raised.
        style
            The traceback style of pytest for other errors.

        """
        if isinstance(excinfo.value, LaunchTestFailure):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Any, int, str]:
        """Return the path, line number and name of the item."""
        function = self.test_run.test_description_function
        return self.path, function.__code__.co_firstlineno - 1, self.name


class LaunchTestModule(pytest.Module):
    """Test module that contains a launch test if its function has the marker."""

    marker = 'launch_test'
    item_class = LaunchTestItem

    def collect(self) -> Iterable[Union[pytest.Item, pytest.Collector]]:
        """Yield the runs of a launch test, or the items of an ordinary module."""
        function = getattr(self.obj, 'generate_test_description', None)
        marks = [mark for mark in getattr(function, 'pytestmark', ()) if mark.name == self.marker]
        if not marks:
            yield from super().collect()
            return
        for run in LoadTestsFromPythonModule(self.obj, name=self.path.stem):
            item = self.item_class.from_parent(self, name=str(run), test_run=run)
            for mark in getattr(function, 'pytestmark', ()):
                item.add_marker(getattr(pytest.mark, mark.name)(*mark.args, **mark.kwargs))
            yield item
