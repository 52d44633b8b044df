# SPDX-License-Identifier: Apache-2.0
"""Mark tests that run after the shutdown of the launch."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar
import unittest

CaseT = TypeVar('CaseT', bound=type[unittest.TestCase])

_ATTRIBUTE = '__launch_test_post_shutdown__'


def post_shutdown_test() -> Callable[[CaseT], CaseT]:
    """Return a TestCase decorator; its tests run after all processes have ended."""

    def decorate(case: CaseT) -> CaseT:
        if not (isinstance(case, type) and issubclass(case, unittest.TestCase)):
            raise TypeError(
                f'post_shutdown_test() decorates subclasses of unittest.TestCase, but not {case!r}'
            )
        setattr(case, _ATTRIBUTE, True)
        return case

    return decorate


def is_post_shutdown_test(case: unittest.TestCase) -> bool:
    """
    Whether a test runs after the shutdown of the launch.

    Parameters
    ----------
    case
        The test.

    """
    return bool(getattr(case, _ATTRIBUTE, False))
