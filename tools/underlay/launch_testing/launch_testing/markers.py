# SPDX-License-Identifier: Apache-2.0
"""Marks on launch descriptions and tests."""

from __future__ import annotations

from collections.abc import Callable
import functools
import time
from typing import Any, Optional, TypeVar

FunctionT = TypeVar('FunctionT', bound=Callable[..., Any])

__all__ = ['is_kept_alive', 'keep_alive', 'retry_on_failure']

_KEEP_ALIVE = '__launch_test_keep_alive__'


def keep_alive(function: FunctionT) -> FunctionT:
    """Let the launch of a `generate_test_description` stay when its processes have ended."""
    setattr(function, _KEEP_ALIVE, True)
    return function


def is_kept_alive(function: Callable[..., Any]) -> bool:
    """Return whether the launch stays when its processes have ended."""
    return bool(getattr(function, _KEEP_ALIVE, False))


def retry_on_failure(
    *,
    times: int,
    delay: Optional[float] = None,
) -> Callable[[FunctionT], FunctionT]:
    """Return a decorator that tries a test again, with `delay` seconds between two attempts."""
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
