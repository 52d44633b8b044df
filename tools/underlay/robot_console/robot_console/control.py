# SPDX-License-Identifier: Apache-2.0
"""Arbitration of the control of a robot."""

from __future__ import annotations

from collections.abc import Hashable

__all__ = ['Control']


class Control:
    """
    Arbitrates the control of a robot: held by no one, or by one user with one or more pages.

    A user takes control with each of these pages, releases it, or loses it when the connection to
    one of them is lost. Then no one is in control, but the robot must not be told that this was
    intentional.

    """

    def __init__(self) -> None:
        self.person = ''
        self.lost = ''
        """The user who lost the connection while in control; empty once someone takes control."""
        self._seats: set[Hashable] = set()

    def take(self, person: str, seat: Hashable) -> bool:
        """
        Take control of the robot from one page.

        Parameters
        ----------
        person
            The user who requests control.
        seat
            The page from which it is taken, for example its session.

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
        Check whether a page holds control.

        Parameters
        ----------
        seat
            The page, as passed to `take`.

        """
        return seat in self._seats

    def give(self, seat: Hashable) -> bool:
        """
        Release the control held by one page.

        Parameters
        ----------
        seat
            The page, as passed to `take`.

        Returns
        -------
        bool
            True if it was the last page of the user in control, so that no one is in control now.

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
        Release control when the connection to a page is lost, for all pages of the user.

        Parameters
        ----------
        seat
            The page that was lost, as passed to `take`.

        Returns
        -------
        bool
            False if the page did not hold control; then nothing changes.

        """
        if seat not in self._seats:
            return False
        self._seats.clear()
        self.person, self.lost = '', self.person
        return True
