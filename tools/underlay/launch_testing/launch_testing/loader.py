# SPDX-License-Identifier: Apache-2.0
"""Load the launch description and the tests of a module."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
import inspect
from types import ModuleType
from typing import Any, Optional
import unittest

from launch import LaunchDescription
from launch_testing._injection import bind
from launch_testing._parametrize import parameter_sets
from launch_testing._post_shutdown_test import is_post_shutdown_test

__all__ = ['LoadTestsFromPythonModule', 'TestRun']

_FUNCTION = 'generate_test_description'


class TestRun:
    """
    Test run: a launch description and its tests.

    Parameters
    ----------
    name
        The name of the run, without its arguments.
    test_description_function
        The function `generate_test_description` of the module.
    param_args
        The keyword arguments of that function; tests may request them, too.
    cases
        All tests of the module.

    """

    __test__ = False

    def __init__(
        self,
        name: str,
        test_description_function: Callable[..., Any],
        param_args: Mapping[str, Any],
        cases: list[unittest.TestCase],
    ) -> None:
        self.name = name
        self.test_description_function = test_description_function
        self.param_args = dict(param_args)
        self._cases = cases

    def __str__(self) -> str:
        """Return the name, with the arguments that distinguish this run from others."""
        arguments = ', '.join(f'{name}={value}' for name, value in self.param_args.items())
        return f'{self.name}[{arguments}]' if arguments else self.name

    @property
    def pre_shutdown_tests(self) -> list[unittest.TestCase]:
        """Return the tests that run while the processes are running."""
        return [case for case in self._cases if not is_post_shutdown_test(case)]

    @property
    def post_shutdown_tests(self) -> list[unittest.TestCase]:
        """Return the tests that run after all processes have ended."""
        return [case for case in self._cases if is_post_shutdown_test(case)]

    def normalized_test_description(
        self,
        ready_fn: Optional[Callable[[], None]] = None,
    ) -> tuple[LaunchDescription, dict[str, Any]]:
        """
        Generate the launch description of the run.

        Parameters
        ----------
        ready_fn
            Passed to the function if it has an argument of this name, to be called when ready.

        Returns
        -------
        tuple
            The LaunchDescription and a dictionary of objects for the tests.

        Raises
        ------
        TypeError
            The function returned an object of another type.

        """
        arguments = dict(self.param_args)
        if 'ready_fn' in inspect.signature(self.test_description_function).parameters:
            arguments['ready_fn'] = ready_fn or (lambda: None)
        result = self.test_description_function(**arguments)
        description, context = result if isinstance(result, tuple) else (result, {})
        if not isinstance(description, LaunchDescription):
            raise TypeError(
                f'{_FUNCTION}() must return a LaunchDescription, or one with a dictionary of '
                f'what the tests need, but it returned {result!r}'
            )
        return description, dict(context)

    def get_launch_description(self) -> LaunchDescription:
        """Return the launch description."""
        return self.normalized_test_description()[0]

    def bind(
        self, cases: list[unittest.TestCase], injected: Mapping[str, Any]
    ) -> unittest.TestSuite:
        """
        Bind objects and the arguments of the run to copies of tests.

        Parameters
        ----------
        cases, injected
            As for `launch_testing._injection.bind`, whose exceptions propagate.

        """
        return bind(cases, {**self.param_args, **injected})


def LoadTestsFromPythonModule(  # noqa: N802
    module: ModuleType,
    *,
    name: str = 'launch_tests',
) -> list[TestRun]:
    """
    Load the runs of a launch test: one for each set of arguments of its function.

    Parameters
    ----------
    module
        The module, which contains `generate_test_description` and test cases.
    name
        The name of the runs.

    Raises
    ------
    AttributeError
        The module has no such function.
    TypeError
        The function cannot be called with its arguments.

    """
    function = getattr(module, _FUNCTION, None)
    if function is None:
        raise AttributeError(
            f"the launch test '{module.__file__}' does not contain the required function "
            f"'{_FUNCTION}()'"
        )
    runs = []
    for arguments in parameter_sets(function):
        _check(module, function, arguments)
        cases = list(_cases(unittest.TestLoader().loadTestsFromModule(module)))
        runs.append(TestRun(name, function, arguments, cases))
    return runs


def _check(module: ModuleType, function: Callable[..., Any], arguments: dict[str, Any]) -> None:
    """Raise a TypeError if a function cannot be called with its arguments."""
    signature = inspect.signature(function)
    names = {*arguments, *({'ready_fn'} & set(signature.parameters))}
    try:
        signature.bind(**dict.fromkeys(names))
    except TypeError as error:
        raise TypeError(
            f"{_FUNCTION}{signature} of '{module.__file__}' cannot be called: {error}. It takes "
            'no arguments, or those that launch_testing.parametrize names'
        ) from None


def _cases(suite: unittest.TestSuite) -> Iterator[unittest.TestCase]:
    """Yield the tests of a suite and of its nested suites."""
    for each in suite:
        if isinstance(each, unittest.TestSuite):
            yield from _cases(each)
        else:
            yield each
