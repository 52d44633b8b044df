# SPDX-License-Identifier: Apache-2.0
"""Scopes of the environment of this process."""

from __future__ import annotations

import os


class EnvironmentScopes:
    """Stack of saved copies of the environment."""

    def __init__(self) -> None:
        """Save the current environment for a reset."""
        self._at_start = dict(os.environ)
        self._stack: list[dict[str, str]] = []

    def push(self) -> None:
        """Save the environment until the next pop."""
        self._stack.append(dict(os.environ))

    def pop(self) -> None:
        """Restore the environment saved by the last push."""
        if not self._stack:
            raise RuntimeError('cannot pop the environment: none has been pushed')
        _restore(self._stack.pop())

    def reset(self) -> None:
        """Restore the initial environment."""
        _restore(self._at_start)


def _restore(kept: dict[str, str]) -> None:
    """Restore the environment from a copy, modifying only variables that differ."""
    for name in [name for name in os.environ if name not in kept]:
        del os.environ[name]
    for name, value in kept.items():
        if os.environ.get(name) != value:
            os.environ[name] = value
