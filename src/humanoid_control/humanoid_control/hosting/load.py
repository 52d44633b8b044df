# SPDX-License-Identifier: Apache-2.0
"""Computing load of the ticks."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class LoadReport:
    """Load of the ticks in a measurement."""

    ticks: int
    mean_ms: float
    worst_ms: float
    share: float
    """Fraction of the time that the ticks took."""


class Load:
    """
    Measurement of the computing time of ticks.

    Parameters
    ----------
    now_s
        Time of a steady clock at the start of the measurement.

    """

    def __init__(self, now_s: float) -> None:
        self._since_s = now_s
        self._took_s: list[float] = []

    def add(self, took_s: float) -> None:
        """
        Record the computing time of one tick.

        Parameters
        ----------
        took_s
            How long the tick took, in real time.

        """
        self._took_s.append(took_s)

    def report(self, now_s: float) -> LoadReport:
        """
        Summarise the load since the last report, and start a new measurement.

        Parameters
        ----------
        now_s
            Time of the steady clock that the measurement was started with.

        """
        passed_s, took_s = now_s - self._since_s, self._took_s
        self._since_s, self._took_s = now_s, []
        busy_s = sum(took_s)
        return LoadReport(
            len(took_s),
            1e3 * busy_s / max(len(took_s), 1),
            1e3 * max(took_s, default=0.0),
            busy_s / passed_s if passed_s > 0.0 else 0.0,
        )
