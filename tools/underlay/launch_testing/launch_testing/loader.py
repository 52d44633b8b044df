# SPDX-License-Identifier: Apache-2.0
"""Load the launch description and the tests of a module, and give the tests what they ask for."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
import functools
import inspect
from types import ModuleType
from typing import Any, Optional
import unittest
from unittest.util import strclass

from launch import LaunchDescription
from launch_testing.markers import is_post_shutdown_test, parameter_sets
from ros_environment.suggestions import did_you_mean

__all__ = ['LoadTestsFromPythonModule', 'TestRun', 'method_name']

_FUNCTION = 'generate_test_description'

_OF_CLASS = ('setUpClass', 'tearDownClass')
_OF_INSTANCE = ('setUp', 'tearDown', 'asyncSetUp', 'asyncTearDown')


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
            As for the function `bind`, whose exceptions propagate.

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


def bind(cases: list[unittest.TestCase], injected: Mapping[str, Any]) -> unittest.TestSuite:
    """
    Bind objects to copies of tests, as attributes and as arguments requested by name.

    Parameters
    ----------
    cases
        The tests, which are not modified.
    injected
        The objects, by the names under which tests request them.

    Returns
    -------
    unittest.TestSuite
        The copies, in the same order.

    Raises
    ------
    TypeError
        A test requests an object that does not exist.

    """
    classes: dict[type[unittest.TestCase], type[unittest.TestCase]] = {}
    suite = unittest.TestSuite()
    for case in cases:
        original = type(case)
        if original not in classes:
            classes[original] = _subclass(original, injected)
        suite.addTest(_bound_case(classes[original], method_name(case), injected))
    return suite


def method_name(case: unittest.TestCase) -> str:
    """
    Return the name of the method that a case runs.

    Parameters
    ----------
    case
        The case; its class may identify it by other names.

    """
    return unittest.TestCase.id(case).removeprefix(f'{strclass(type(case))}.')


def _subclass(
    original: type[unittest.TestCase],
    injected: Mapping[str, Any],
) -> type[unittest.TestCase]:
    """
    Create a subclass with the objects as attributes and with bound set-up methods.

    Objects whose names clash with attributes of TestCase are available as arguments only.
    """
    attributes = {
        name: staticmethod(value) if inspect.isfunction(value) else value
        for name, value in injected.items()
        if not hasattr(unittest.TestCase, name)
    }
    names = {
        '__module__': original.__module__,
        '__qualname__': original.__qualname__,
        '__doc__': original.__doc__,
    }
    result = type(original.__name__, (original,), {**attributes, **names})
    for name in _OF_CLASS:
        setattr(result, name, staticmethod(_bound(getattr(result, name), injected)))
    return result


def _bound_case(
    case_class: type[unittest.TestCase],
    method_name: str,
    injected: Mapping[str, Any],
) -> unittest.TestCase:
    case = case_class(method_name)
    for name in (*_OF_INSTANCE, method_name):
        if hasattr(case, name):
            setattr(case, name, _bound(getattr(case, name), injected))
    return case


def _bound(method: Callable[..., Any], injected: Mapping[str, Any]) -> Callable[..., Any]:
    """Bind the injected arguments of a method."""
    parameters = inspect.signature(method).parameters
    arguments = {name: injected[name] for name in parameters if name in injected}
    if not hasattr(method, '__wrapped__'):
        _require_known(method, parameters, injected)
    if not arguments:
        return method
    return functools.update_wrapper(functools.partial(method, **arguments), method)


def _require_known(
    method: Callable[..., Any],
    parameters: Mapping[str, inspect.Parameter],
    injected: Mapping[str, Any],
) -> None:
    """Raise a TypeError if a method requests an object that does not exist."""
    for name, parameter in parameters.items():
        if (
            name in injected
            or parameter.default is not parameter.empty
            or parameter.kind in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD)
        ):
            continue
        question = did_you_mean(name, injected)
        hint = f'. {question}' if question else ''
        raise TypeError(
            f"{method.__qualname__} asks for '{name}', but a launch test can only be given: "
            f'{", ".join(sorted(injected))}{hint}'
        )
