# SPDX-License-Identifier: Apache-2.0
"""Who is in control of a robot."""

from __future__ import annotations

from collections.abc import Hashable

__all__ = ['Control']


class Control:
    """
    Who is in control of a robot: nobody, or one person, from one or several small pages.

    A person takes control with each of these pages, gives it back, or is lost with one of them.
    Then nobody is in control, but the robot must not be told that this was on purpose.
    """

    def __init__(self) -> None:
        """Begin with nobody in control."""
        self.person = ''
        self.lost = ''
        """Who was in control when the connection was lost, until somebody else is."""
        self._seats: set[Hashable] = set()

    def take(self, person: str, seat: Hashable) -> bool:
        """Take control with a page, and tell if that is possible."""
        if self.person and self.person != person:
            return False
        self.person, self.lost = person, ''
        self._seats.add(seat)
        return True

    def holds(self, seat: Hashable) -> bool:
        """Tell whether control was taken with a page."""
        return seat in self._seats

    def give(self, seat: Hashable) -> bool:
        """Give back what was taken with a page, and tell if nobody is in control now."""
        if seat not in self._seats:
            return False
        self._seats.remove(seat)
        if self._seats:
            return False
        self.person = ''
        return True

    def lose(self, seat: Hashable) -> bool:
        """Take note that a page is gone, and tell if somebody was in control with it."""
        if seat not in self._seats:
            return False
        self._seats.clear()
        self.person, self.lost = '', self.person
        return True
