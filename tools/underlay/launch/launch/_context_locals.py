# SPDX-License-Identifier: Apache-2.0
"""The local variables of a launch context."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any


class ContextLocals:
    """Local variables, valid while one event is handled, on top of global variables."""

    def __init__(self) -> None:
        self._globals: dict[str, Any] = {}
        self._locals: dict[str, Any] = {}
        self._stack: list[dict[str, Any]] = []
        self.view = LocalsView(self)

    def as_dict(self) -> dict[str, Any]:
        """Return a copy of all the variables."""
        return {**self._globals, **self._locals}

    def extend(self, extra: Mapping[str, Any]) -> None:
        """
        Add variables that last until the next pop.

        Parameters
        ----------
        extra
            The values by name; they hide global variables of the same names.

        """
        self._locals.update(extra)

    def extend_globals(self, extra: Mapping[str, Any]) -> None:
        """
        Add variables that last as long as the context.

        Parameters
        ----------
        extra
            The values by name.

        """
        self._globals.update(extra)

    def push(self) -> None:
        """Save the local variables until the next pop."""
        self._stack.append(dict(self._locals))

    def pop(self) -> None:
        """Restore the local variables saved by the last push."""
        if not self._stack:
            raise RuntimeError('cannot pop the locals: none have been pushed')
        self._locals = self._stack.pop()


class LocalsView:
    """
    Read-only view of variables, each as an attribute.

    Parameters
    ----------
    owner
        The variables to view; each access reflects their current values.

    """

    __slots__ = ('_owner',)

    def __init__(self, owner: ContextLocals) -> None:
        object.__setattr__(self, '_owner', owner)

    def __getattr__(self, name: str) -> Any:
        """Return a variable; for an unknown name, raise an error that lists the available ones."""
        known = self._owner.as_dict()
        if name in known:
            return known[name]
        names = ', '.join(f"'{each}'" for each in known) or 'none'
        raise AttributeError(
            f"context.locals has no attribute '{name}'; the available ones are: {names}"
        )

    def __setattr__(self, name: str, value: Any) -> None:
        """Reject assignment; variables are added with `extend_locals`."""
        raise AttributeError(
            f"context.locals.{name} cannot be set; use context.extend_locals({{'{name}': ...}})"
        )
