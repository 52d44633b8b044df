# SPDX-License-Identifier: Apache-2.0
"""Rate-limited report of the first joint of a stream of joint states."""

from __future__ import annotations

from collections.abc import Sequence


class JointReporter:
    """
    Formatter of the first joint of joint states as a line of text, at most once per period.

    Parameters
    ----------
    period_s
        Minimum time between two reports.

    """

    def __init__(self, period_s: float) -> None:
        self.period_s = period_s
        self._last_s: float | None = None

    def report(
        self,
        names: Sequence[str],
        positions_rad: Sequence[float],
        now_s: float,
    ) -> str | None:
        """
        Format the position of the first joint, at most once per period.

        Parameters
        ----------
        names, positions_rad
            The joint state, in the same order.
        now_s
            Time of a steady clock.

        Returns
        -------
        str or None
            One line; None if the period has not passed yet, or there is no joint.

        """
        if not names or not positions_rad or not self._is_due(now_s):
            return None
        self._last_s = now_s
        return f'{names[0]}: {positions_rad[0]:.3f} rad'

    def _is_due(self, now_s: float) -> bool:
        """Check whether a period has passed since the last report."""
        return self._last_s is None or now_s - self._last_s >= self.period_s
