# SPDX-License-Identifier: Apache-2.0
"""Fallback order of the rendering methods."""

from __future__ import annotations

from collections.abc import Sequence

_MOST_DEATHS = 3


class Ladder:
    """
    Fallback order of rendering methods, and why those that were tried have failed.

    A method that has rendered before is retried when its process ends, until that happens three
    times without an image in between.

    Parameters
    ----------
    methods : Sequence[str]
        The methods, best first.

    """

    def __init__(self, methods: Sequence[str]) -> None:
        self._methods = list(methods)
        self._deaths = 0
        self._has_drawn = False
        self.failures: dict[str, str] = {}
        """The reason why a method cannot be used, by method."""

    @property
    def method(self) -> str:
        """Return the method to use; '' if none is left."""
        left = [method for method in self._methods if method not in self.failures]
        return left[0] if left else ''

    def note_picture(self) -> None:
        """Record that the method has rendered an image."""
        self._has_drawn = True
        self._deaths = 0

    def note_end(self, reason: str) -> bool:
        """
        Record why a render process ended, and decide whether to try its method again.

        Parameters
        ----------
        reason
            Why it ended, as a sentence; it is kept in `failures` if the method is given up.

        Returns
        -------
        bool
            Whether the same method gets another chance; if not, `method` is the next one.

        """
        self._deaths += 1
        if self._has_drawn and self._deaths < _MOST_DEATHS:
            return True
        self.failures[self.method] = reason
        self._deaths = 0
        self._has_drawn = False
        return False
