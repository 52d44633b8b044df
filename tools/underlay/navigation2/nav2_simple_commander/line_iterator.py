# SPDX-License-Identifier: Apache-2.0
"""Iterate over the points of a line in steps."""

from __future__ import annotations

__all__ = ['LineIterator']


class LineIterator:
    """
    Iterator over the points of a line.

    Parameters
    ----------
    x0, y0, x1, y1
        The ends of the line.
    step_size
        The change of x from one point to the next, or of y if the line is vertical.

    Raises
    ------
    TypeError
        The step is not a number.
    ValueError
        The step is not greater than 0.

    """

    def __init__(self, x0: float, y0: float, x1: float, y1: float, step_size: float = 1.0) -> None:
        if isinstance(step_size, bool) or not isinstance(step_size, (int, float)):
            raise TypeError(f'step_size must be a number, but is {step_size!r}.')
        if step_size <= 0:
            raise ValueError(f'step_size must be greater than 0, but is {step_size:g}.')
        self._x0, self._y0, self._x1, self._y1 = x0, y0, x1, y1
        self._x, self._y, self._step = x0, y0, step_size
        self._is_valid = True

    def isValid(self) -> bool:  # noqa: N802
        """Whether the current point is on the line, not past its end."""
        return self._is_valid

    def advance(self) -> None:
        """Advance to the next point; the last one is the end of the line."""
        x0, y0, x1, y1 = self._x0, self._y0, self._x1, self._y1
        if (self._x, self._y) == (x1, y1):
            self._is_valid = False
        elif x0 == x1:
            self._y = _toward(self._y, y1, self._step)
        else:
            self._x = _toward(self._x, x1, self._step)
            self._y = y1 if self._x == x1 else y0 + (y1 - y0) / (x1 - x0) * (self._x - x0)

    def getX(self) -> float:  # noqa: N802
        """Return x of the current point."""
        return self._x

    def getY(self) -> float:  # noqa: N802
        """Return y of the current point."""
        return self._y

    def getX0(self) -> float:  # noqa: N802
        """Return x of the start."""
        return self._x0

    def getY0(self) -> float:  # noqa: N802
        """Return y of the start."""
        return self._y0

    def getX1(self) -> float:  # noqa: N802
        """Return x of the end."""
        return self._x1

    def getY1(self) -> float:  # noqa: N802
        """Return y of the end."""
        return self._y1

    def get_line_length(self) -> float:
        """Return the length of the line."""
        return float(((self._x1 - self._x0) ** 2 + (self._y1 - self._y0) ** 2) ** 0.5)


def _toward(value: float, end: float, step: float) -> float:
    """Step a value towards an end, without overshoot."""
    return min(value + step, end) if end > value else max(value - step, end)
