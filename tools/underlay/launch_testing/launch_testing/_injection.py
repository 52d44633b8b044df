# SPDX-License-Identifier: Apache-2.0
"""Inject objects into tests, as attributes and as arguments requested by name."""

from __future__ import annotations

from collections.abc import Callable, Mapping
import functools
import inspect
from typing import Any
import unittest

from launch._did_you_mean import did_you_mean

_OF_CLASS = ('setUpClass', 'tearDownClass')
_OF_INSTANCE = ('setUp', 'tearDown', 'asyncSetUp', 'asyncTearDown')


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
        suite.addTest(_bound_case(classes[original], case._testMethodName, injected))
    return suite


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
