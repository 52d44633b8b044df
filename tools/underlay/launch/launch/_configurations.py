# SPDX-License-Identifier: Apache-2.0
"""The launch configurations, and what anyone has wanted to know of them."""

from __future__ import annotations

from collections.abc import ItemsView, Iterator, KeysView, ValuesView
from typing import Any


class LaunchConfigurations(dict[str, Any]):
    """A dictionary that notes which names are looked up; who goes through all sees all."""

    def __init__(self) -> None:
        super().__init__()
        self.looked_up: set[Any] = set()
        self.declared: set[str] = set()

    def snapshot(self) -> dict[str, Any]:
        """Return a plain copy; this is not a look-up."""
        return dict(dict.items(self))

    def __getitem__(self, name: str) -> Any:
        """Return a value."""
        self.looked_up.add(name)
        return super().__getitem__(name)

    def __contains__(self, name: object) -> bool:
        """Return whether there is a value."""
        self.looked_up.add(name)
        return super().__contains__(name)

    def get(self, name: str, default: Any = None) -> Any:
        """
        Get the value of a launch configuration, and record the look-up.

        Parameters
        ----------
        name, default
            The name, and what is returned if there is no such configuration.

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
            What is returned if there is none.

        Raises
        ------
        KeyError
            There is no such configuration, and no default.

        """
        self.looked_up.add(name)
        return super().pop(name, *default)

    def setdefault(self, name: str, default: Any = None) -> Any:
        """
        Get the value of a launch configuration, which is set first if there is none.

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
        """Return a plain copy, of which anything may be read."""
        self.looked_up.update(self.snapshot())
        return self.snapshot()
