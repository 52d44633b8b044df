# SPDX-License-Identifier: Apache-2.0
"""Short names for those who have a page open."""

from __future__ import annotations

from collections import Counter

__all__ = ['People']


class People:
    """Names such as `browser 2 (127.0.0.1)`, one for all connections of a page."""

    def __init__(self) -> None:
        self._names: dict[str, str] = {}
        self._connections: Counter[str] = Counter()
        self._count = 0

    def arrive(self, key: str, address: str) -> str:
        """
        Register a connection of a page, and name the page.

        Parameters
        ----------
        key
            The identifier that the page made up, the same for all of its connections.
        address
            The IP address of the browser.

        Returns
        -------
        str
            The name; a page that is connected already keeps its own.

        """
        self._connections[key] += 1
        if key not in self._names:
            self._count += 1
            self._names[key] = f'browser {self._count} ({address})'
        return self._names[key]

    def leave(self, key: str) -> None:
        """
        Unregister a connection of a page; the name is forgotten with the last one.

        Parameters
        ----------
        key
            The identifier, as for `arrive`.

        """
        self._connections[key] -= 1
        if not self._connections[key]:
            del self._connections[key], self._names[key]
