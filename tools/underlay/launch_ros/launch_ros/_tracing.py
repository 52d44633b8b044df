# SPDX-License-Identifier: Apache-2.0
"""Keep LTTng tracing working in forked processes."""

from __future__ import annotations

from collections.abc import Callable
import os
from typing import Any

_NAME = 'liblttng-ust'
_PREFIXES = ('lttng_ust_', 'ust_')  # of the function names, since version 2.13 and before
_SIZE_OF_A_SIGNAL_SET = 128


class Tracing:
    """
    Fork handler of the LTTng-UST library that rclpy loads, which has its own threads.

    The library must be notified of each fork, and restarts its threads in the child process;
    without that, the child crashes on exit.
    """

    def __init__(self) -> None:
        """Create a handler; libraries are looked up on `before_fork`."""
        self._after: list[Callable[[Any], None]] = []
        self._signals: Any = None

    def before_fork(self) -> None:
        """Notify the library of an imminent fork."""
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
        """Restart the library in the child process."""
        for function in self._after:
            function(self._signals)


def _loaded_paths() -> list[str]:
    """Return the paths of the LTTng-UST libraries that this process has loaded."""
    with open('/proc/self/maps') as file:
        paths = {line.rstrip('\n').partition('/')[2] for line in file}
    return sorted(f'/{path}' for path in paths if os.path.basename(path).startswith(_NAME))
