# SPDX-License-Identifier: Apache-2.0
"""Markers for launch descriptions and tests."""

from __future__ import annotations

from collections.abc import Callable
import functools
import time
from typing import Any, Optional, TypeVar

FunctionT = TypeVar('FunctionT', bound=Callable[..., Any])

__all__ = ['is_kept_alive', 'keep_alive', 'retry_on_failure']

_KEEP_ALIVE = '__launch_test_keep_alive__'


def keep_alive(function: FunctionT) -> FunctionT:
    """
    Mark a `generate_test_description` whose launch continues after its processes have ended.

    Parameters
    ----------
    function
        The function, which is returned unchanged.

    """
    setattr(function, _KEEP_ALIVE, True)
    return function


def is_kept_alive(function: Callable[..., Any]) -> bool:
    """
    Whether the launch of a function continues after its processes have ended.

    Parameters
    ----------
    function
        The function `generate_test_description`.

    """
    return bool(getattr(function, _KEEP_ALIVE, False))


def retry_on_failure(
    *,
    times: int,
    delay: Optional[float] = None,
) -> Callable[[FunctionT], FunctionT]:
    """
    Return a decorator that retries a test after an AssertionError.

    Parameters
    ----------
    times
        The maximum number of attempts.
    delay
        The delay between two attempts, in s; None for no delay.

    Raises
    ------
    ValueError
        The number of attempts is less than 1.

    """
    if times < 1:
        raise ValueError(f'a test must be tried at least once, but times={times}')

    def decorate(test: FunctionT) -> FunctionT:
        @functools.wraps(test)
        def attempt(*args: Any, **kwargs: Any) -> Any:
            for _ in range(times - 1):
                try:
                    return test(*args, **kwargs)
                except AssertionError:
                    time.sleep(delay or 0.0)
            return test(*args, **kwargs)

        return attempt  # type: ignore[return-value]

    return decorate
