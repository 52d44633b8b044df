# SPDX-License-Identifier: Apache-2.0
"""The scoped state of a launch context: launch configurations, local variables, environment."""

from __future__ import annotations

from collections.abc import ItemsView, Iterator, KeysView, Mapping, ValuesView
import os
from typing import Any


class LaunchConfigurations(dict[str, Any]):
    """Dictionary that records which names are looked up; iterating looks up all of them."""

    def __init__(self) -> None:
        super().__init__()
        self.looked_up: set[Any] = set()
        self.declared: set[str] = set()
        self._scopes: list[dict[str, Any]] = []

    def snapshot(self) -> dict[str, Any]:
        """Return a plain copy without recording a look-up."""
        return dict(dict.items(self))

    def push_scope(self) -> None:
        """Save the launch configurations until `pop_scope`."""
        self._scopes.append(self.snapshot())

    def pop_scope(self) -> None:
        """Restore the launch configurations saved by the last `push_scope`."""
        if not self._scopes:
            raise RuntimeError('cannot pop the launch configurations: none have been pushed')
        kept = self._scopes.pop()
        self.clear()
        self.update(kept)

    def __getitem__(self, name: str) -> Any:
        """Return a value and record the look-up."""
        self.looked_up.add(name)
        return super().__getitem__(name)

    def __contains__(self, name: object) -> bool:
        """Check whether a name is set, and record the look-up."""
        self.looked_up.add(name)
        return super().__contains__(name)

    def get(self, name: str, default: Any = None) -> Any:
        """
        Get the value of a launch configuration, and record the look-up.

        Parameters
        ----------
        name, default
            The name, and the value returned if the configuration is not set.

        """
        self.looked_up.add(name)
        return super().get(name, default)

    def pop(self, name: str, *default: Any) -> Any:
        """
        Remove a launch configuration and return its value.

        Parameters
        ----------
        name
            The name of the configuration.
        *default
            The value returned if it is not set.

        Raises
        ------
        KeyError
            The configuration is not set, and there is no default.

        """
        self.looked_up.add(name)
        return super().pop(name, *default)

    def setdefault(self, name: str, default: Any = None) -> Any:
        """
        Get the value of a launch configuration; set it first if it is not set.

        Parameters
        ----------
        name, default
            The name, and the value that is set.

        """
        self.looked_up.add(name)
        return super().setdefault(name, default)

    def __iter__(self) -> Iterator[str]:
        """Iterate over the names."""
        self.looked_up.update(self.snapshot())
        return super().__iter__()

    def keys(self) -> KeysView[str]:  # type: ignore[override]
        """Return the names."""
        self.looked_up.update(self.snapshot())
        return super().keys()

    def values(self) -> ValuesView[Any]:  # type: ignore[override]
        """Return the values."""
        self.looked_up.update(self.snapshot())
        return super().values()

    def items(self) -> ItemsView[str, Any]:  # type: ignore[override]
        """Return the names and values."""
        self.looked_up.update(self.snapshot())
        return super().items()

    def copy(self) -> dict[str, Any]:
        """Return a plain copy and record a look-up of every name."""
        self.looked_up.update(self.snapshot())
        return self.snapshot()


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
