# SPDX-License-Identifier: Apache-2.0
"""The launch configurations, with a record of look-ups."""

from __future__ import annotations

from collections.abc import ItemsView, Iterator, KeysView, ValuesView
from typing import Any


class LaunchConfigurations(dict[str, Any]):
    """Dictionary that records which names are looked up; iterating looks up all of them."""

    def __init__(self) -> None:
        super().__init__()
        self.looked_up: set[Any] = set()
        self.declared: set[str] = set()

    def snapshot(self) -> dict[str, Any]:
        """Return a plain copy without recording a look-up."""
        return dict(dict.items(self))

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
