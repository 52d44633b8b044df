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
        self.person = ''
        self.lost = ''
        """Who was in control when the connection was lost, until somebody else is."""
        self._seats: set[Hashable] = set()

    def take(self, person: str, seat: Hashable) -> bool:
        """
        Take control of the robot with one page.

        Parameters
        ----------
        person
            Who wants it.
        seat
            The page with which it is taken, such as its session.

        Returns
        -------
        bool
            False if another person is in control.

        """
        if self.person and self.person != person:
            return False
        self.person, self.lost = person, ''
        self._seats.add(seat)
        return True

    def holds(self, seat: Hashable) -> bool:
        """
        Check whether control was taken with a page.

        Parameters
        ----------
        seat
            The page, as it was given to `take`.

        """
        return seat in self._seats

    def give(self, seat: Hashable) -> bool:
        """
        Give back the control that was taken with one page.

        Parameters
        ----------
        seat
            The page, as it was given to `take`.

        Returns
        -------
        bool
            True if that was the last page of the person in control, so that nobody is now.

        """
        if seat not in self._seats:
            return False
        self._seats.remove(seat)
        if self._seats:
            return False
        self.person = ''
        return True

    def lose(self, seat: Hashable) -> bool:
        """
        End the control of a person one of whose pages is gone, with all of that person's pages.

        Parameters
        ----------
        seat
            The page that is gone, as it was given to `take`.

        Returns
        -------
        bool
            False if control was not taken with this page; then nothing changes.

        """
        if seat not in self._seats:
            return False
        self._seats.clear()
        self.person, self.lost = '', self.person
        return True
