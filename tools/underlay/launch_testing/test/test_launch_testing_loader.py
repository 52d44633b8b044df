# SPDX-License-Identifier: Apache-2.0
"""How launch tests are found, and what they are given."""

from __future__ import annotations

from collections.abc import Callable
import io
from types import ModuleType
from typing import Any
import unittest

import launch_testing
from launch_testing.loader import bind, LoadTestsFromPythonModule
from launch_testing.markers import retry_on_failure
import pytest

Load = Callable[[str], ModuleType]

PARAMETRIZED = """
@launch_testing.parametrize('a', [1, 2])
@launch_testing.parametrize('b, c', [(3, 4), (5, 6)])
def generate_test_description(a, b, c, ready_fn):
    return LaunchDescription(), {'sum': a + b + c}

class TestIt(unittest.TestCase):
    def test_one(self, a): pass
    def test_two(self): pass

@launch_testing.post_shutdown_test()
class TestAfter(unittest.TestCase):
    def test_three(self): pass
"""


def test_runs(module: Load) -> None:
    """There is a run for each combination of arguments, with both kinds of tests."""
    runs = LoadTestsFromPythonModule(module(PARAMETRIZED), name='x')
    assert [str(run) for run in runs] == [
        'x[b=3, c=4, a=1]',
        'x[b=5, c=6, a=1]',
        'x[b=3, c=4, a=2]',
        'x[b=5, c=6, a=2]',
    ]
    assert [case._testMethodName for case in runs[0].pre_shutdown_tests] == [
        'test_one',
        'test_two',
    ]
    assert [case._testMethodName for case in runs[0].post_shutdown_tests] == ['test_three']
    assert runs[-1].normalized_test_description()[1] == {'sum': 13}


def test_missing_function(module: Load) -> None:
    """A file without the function is named."""
    with pytest.raises(AttributeError, match=r"sample_launch.py' does not contain .*description"):
        LoadTestsFromPythonModule(module(''))


def test_wrong_arguments(module: Load) -> None:
    """A function that cannot be called is an error before anything starts."""
    with pytest.raises(TypeError, match="missing a required argument: 'x'. It takes no arguments"):
        LoadTestsFromPythonModule(module('def generate_test_description(x): pass'))


def test_wrong_result(module: Load) -> None:
    """The function must return a launch description."""
    (run,) = LoadTestsFromPythonModule(module('def generate_test_description(): return 5'))
    with pytest.raises(TypeError, match='must return a LaunchDescription.* but it returned 5'):
        run.get_launch_description()


def test_wrong_parametrization() -> None:
    """Each name needs a value."""
    with pytest.raises(ValueError, match=r'the 2 names a, b, but the 1 values \(1,\)'):
        launch_testing.parametrize('a, b', [(1,)])
    with pytest.raises(TypeError, match='decorates subclasses of unittest.TestCase'):
        launch_testing.post_shutdown_test()(5)  # type: ignore[type-var]


class Sample(unittest.TestCase):
    """Tests that are given something."""

    @classmethod
    def setUpClass(cls, number: int) -> None:  # type: ignore[override]
        """Note the number."""
        cls.seen = [number]

    def setUp(self, text: str) -> None:  # type: ignore[override]
        """Note the text."""
        self.seen[1:] = [text]

    def test_it(self, number: int, default: int = 5) -> None:
        """Arguments and attributes are there."""
        assert (self.seen, self.number, number, default) == ([1, 'x'], 1, 1, 5)

    @unittest.skip('no reason')
    def test_left_out(self, number: int) -> None:
        """Marks are kept."""

    @unittest.expectedFailure
    def test_failing(self, number: int) -> None:
        """Marks are kept."""
        raise AssertionError

    @retry_on_failure(times=3)
    def test_stubborn(self, attempts: list[int]) -> None:
        """The test is tried thrice."""
        attempts.append(1)
        assert len(attempts) == 3


class AsyncSample(unittest.IsolatedAsyncioTestCase):
    """Asynchronous tests that are given something."""

    async def test_it(self, number: int) -> None:
        """The argument is there."""
        assert number == 1


def test_injection() -> None:
    """Set-up functions and tests get what they ask for; the classes stay as they were."""
    cases: list[Any] = [
        *unittest.TestLoader().loadTestsFromTestCase(Sample),
        *unittest.TestLoader().loadTestsFromTestCase(AsyncSample),
    ]
    suite = bind(cases, {'number': 1, 'text': 'x', 'attempts': []})
    result = unittest.TextTestRunner(io.StringIO()).run(suite)
    assert result.testsRun == 5 and result.wasSuccessful(), result.failures + result.errors
    assert len(result.skipped) == 1 and len(result.expectedFailures) == 1
    assert not hasattr(Sample, 'number')


class Clashing(unittest.TestCase):
    """A test on a launch whose function returned all its local variables."""

    def test_it(self, run: int, double: Callable[[int], int]) -> None:
        """Functions stay functions, and TestCase keeps its own parts."""
        assert (run, double(4), self.double(4)) == (3, 8, 8)


def test_injection_of_any_local_variable() -> None:
    """Names of TestCase itself are handed over as arguments only."""
    suite = bind([Clashing('test_it')], {'run': 3, 'id': 4, 'double': lambda number: 2 * number})
    result = unittest.TextTestRunner(io.StringIO()).run(suite)
    assert result.testsRun == 1 and result.wasSuccessful(), result.failures + result.errors


def test_unknown_argument() -> None:
    """A test that asks for what nobody has is told what there is."""
    with pytest.raises(TypeError, match="Sample.setUpClass asks for 'number'.*: numbers, text. D"):
        bind([Sample('test_it')], {'numbers': 1, 'text': 'x'})


def test_retries_end() -> None:
    """The last failure counts, and less than one attempt makes no sense."""
    calls: list[int] = []

    @retry_on_failure(times=2, delay=0.0)
    def fail() -> None:
        calls.append(1)
        raise AssertionError('no')

    with pytest.raises(AssertionError, match='no'):
        fail()
    assert len(calls) == 2
    with pytest.raises(ValueError, match='at least once, but times=0'):
        retry_on_failure(times=0)


# These classes are data of the tests above, not tests of their own.
Sample.__test__ = AsyncSample.__test__ = Clashing.__test__ = False  # type: ignore[attr-defined]
