# SPDX-License-Identifier: Apache-2.0
"""Let copies of a process be traced as if they had loaded the tracing library themselves."""

from __future__ import annotations

from collections.abc import Callable
import os
from typing import Any

_NAME = 'liblttng-ust'
_PREFIXES = ('lttng_ust_', 'ust_')  # of the functions, from version 2.13 on and before
_SIZE_OF_A_SIGNAL_SET = 128


class Tracing:
    """
    The tracing library that rclpy loads, which has threads of its own.

    It wants to be told of each fork, and starts its threads again in the copy; without that, a
    copy crashes at its end.
    """

    def __init__(self) -> None:
        """Look for nothing yet."""
        self._after: list[Callable[[Any], None]] = []
        self._signals: Any = None

    def before_fork(self) -> None:
        """Hold the library still."""
        import ctypes

        self._signals = ctypes.create_string_buffer(_SIZE_OF_A_SIGNAL_SET)
        for path in _loaded_paths():
            library = ctypes.PyDLL(path)
            for prefix in _PREFIXES:
                if hasattr(library, f'{prefix}before_fork'):
                    getattr(library, f'{prefix}before_fork')(self._signals)
                    self._after.append(getattr(library, f'{prefix}after_fork_child'))
                    break

    def after_fork(self) -> None:
        """Let the library start anew in the copy."""
        for function in self._after:
            function(self._signals)


def _loaded_paths() -> list[str]:
    """Return the paths of the library and its parts that this process has loaded."""
    with open('/proc/self/maps') as file:
        paths = {line.rstrip('\n').partition('/')[2] for line in file}
    return sorted(f'/{path}' for path in paths if os.path.basename(path).startswith(_NAME))
